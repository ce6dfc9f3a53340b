#include "state/trigonometry.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace halfspace::state {
namespace {

// value = high + low, low beyond high's last bit.
struct DoubleDouble {
  double high, low;
};

// The leading 26 significant bits: products of two such numbers are exact.
double upper_half(double v) {
  return std::bit_cast<double>(std::bit_cast<uint64_t>(v) & 0xffff'ffff'f800'0000u);
}

// Degrees to radians, to about 2^-80. pi / 180 = kHigh + kLow, kHigh of 26 bits.
DoubleDouble radians(double degrees) {
  constexpr double kHigh = 0x1.1df46ap-6;
  constexpr double kLow = 0x1.294e9c8ae0ec6p-33;
  const double a = upper_half(degrees), b = degrees - a;
  const double head = a * kHigh;
  const double tail = b * kHigh + degrees * kLow;
  const double high = head + tail;
  return {high, (head - high) + tail};
}

// Both for |x| <= pi/4 by their Taylor series; the first omitted term is below 2^-60 of the result.
double sine(DoubleDouble x) {
  const double z = x.high * x.high;
  double p = 1.0 / 355687428096000;  // 1 / 17!
  p = p * z - 1.0 / 1307674368000;
  p = p * z + 1.0 / 6227020800;
  p = p * z - 1.0 / 39916800;
  p = p * z + 1.0 / 362880;
  p = p * z - 1.0 / 5040;
  p = p * z + 1.0 / 120;
  p = p * z - 1.0 / 6;
  return x.high + (x.high * z * p + x.low * (1 - 0.5 * z));
}

double cosine(DoubleDouble x) {
  const double z = x.high * x.high;
  double p = 1.0 / 20922789888000;  // 1 / 16!
  p = p * z - 1.0 / 87178291200;
  p = p * z + 1.0 / 479001600;
  p = p * z - 1.0 / 3628800;
  p = p * z + 1.0 / 40320;
  p = p * z - 1.0 / 720;
  p = p * z + 1.0 / 24;
  const double half = 0.5 * z, one_less_half = 1 - half;
  return one_less_half + (((1 - one_less_half) - half) + (z * z * p - x.high * x.low));
}

}  // namespace

SineCosine sine_cosine_degrees(double degrees) {
  // fmod, round and the subtraction are exact, so the remainder is: |rest| <= 45.
  const double turn = std::fmod(degrees, 360.0);
  if (std::isnan(turn)) return {turn, turn};
  const double quarters = std::round(turn / 90.0);
  const double rest = turn - 90.0 * quarters;
  const DoubleDouble x = radians(rest);
  const double s = sine(x), c = cosine(x);
  switch (int(quarters) & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, 0 - s};
    case 2:
      return {0 - s, -c};
    default:
      return {-c, s};
  }
}

}  // namespace halfspace::state
