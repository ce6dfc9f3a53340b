// Powers and logarithms of the exact level, in double, one value at a time. Included once an ISA level: no fused
// multiply-add, no libm, so all agree. Errors are those docs/numerics.md states; tests/numerics/accuracy_test.cpp
// holds them to that.

HWY_INLINE uint64_t BitsOf(double v) {
  uint64_t bits;
  memcpy(&bits, &v, sizeof bits);
  return bits;
}
HWY_INLINE double FromBits(uint64_t bits) {
  double v;
  memcpy(&v, &bits, sizeof v);
  return v;
}

// log2 x of a normal, positive x: exact at powers of two. 2 / ln 2 * artanh t as a series in t = (m - 1) / (m + 1), for
// the mantissa m in [sqrt 1/2, sqrt 2); |t| <= 0.1716, so what is left out is below 2e-18.
HWY_INLINE double ExactLog2(double x) {
  const uint64_t bits = BitsOf(x);
  const uint64_t shifted = bits - 0x3fe6a09e667f3bcdu;  // sqrt 1/2
  const auto exponent = static_cast<int64_t>(shifted) >> 52;
  const double m = FromBits(bits - (static_cast<uint64_t>(exponent) << 52));
  const double t = (m - 1) / (m + 1), t2 = t * t;
  double sum = 0;
  for (int k = 11; k >= 1; --k) sum = (sum + 1.0 / (2 * k + 1)) * t2;
  constexpr double kScale = 2.8853900817779268147;  // 2 / ln 2
  return static_cast<double>(exponent) + kScale * (t + t * sum);
}

// e^(r + low) 2^n for |r| <= 0.35 and `low` what r is off, by the series to r^13: what is left out is below 5e-18. n may
// be -1021 .. 1022.
HWY_INLINE double ScaledExp(double r, double low, int64_t n) {
  constexpr double kFactorial[] = {1.0 / 6227020800, 1.0 / 479001600, 1.0 / 39916800, 1.0 / 3628800, 1.0 / 362880,
                                   1.0 / 40320,      1.0 / 5040,      1.0 / 720,      1.0 / 120,     1.0 / 24,
                                   1.0 / 6,          1.0 / 2};
  double sum = 0;
  for (double term : kFactorial) sum = (sum + term) * r;
  return (1 + (r + (sum * r + low))) * FromBits(static_cast<uint64_t>(n + 1023) << 52);
}

// e^-x for x >= 0; what is below 1e-304 is 0, and so is the result for NaN.
HWY_INLINE double ExactExpMinus(double x) {
  if (!(x < 700)) return 0;
  const auto n = static_cast<int64_t>(x * 1.4426950408889634074 + 0.5);
  // ln 2 in two parts, the first so short that its products with n are exact.
  const double whole = static_cast<double>(n);
  const double high = whole * 0x1.62e42feep-1 - x, low = whole * 0x1.a39ef35793c76p-33;
  const double r = high + low;
  return ScaledExp(r, (high - r) + low, -n);
}

// x^s by the rules of raster/vertex/lighting.h: 0 for what is below 2^-125, 2^64 for what is above it.
HWY_INLINE double ExactPower(double x, double s) {
  if (!(x >= 0x1p-126)) return s == 0 ? 1 : 0;
  const double y = s * ExactLog2(x);
  if (!(y >= -125)) return 0;
  if (y > 64) return 0x1p64;
  const double n = __builtin_floor(y + 0.5);
  return ScaledExp((y - n) * 0.69314718055994530942, 0, static_cast<int64_t>(n));
}
