#include "tests/oracle/fragment.h"

#include <algorithm>

namespace halfspace::oracle {

using raster::BaseFormat;
using raster::BlendFactor;
using raster::CompareFunc;
using raster::EnvMode;

namespace {

// One component of tables 3.22 and 3.23 for a texture that has this component.
long double combine(EnvMode mode, long double f, long double t, long double c) {
  switch (mode) {
    case EnvMode::modulate:
      return f * t;
    case EnvMode::blend:
      return f * (1 - t) + c * t;
    default:
      return t;  // replace, decal
  }
}

// Table 4.1 and 4.2; s and d in units in which `one` is 1.
template <class T, class Colors>
T factor(BlendFactor f, const Colors& s, const Colors& d, size_t i, T one) {
  const auto value = [](auto v) { return static_cast<T>(v); };
  switch (f) {
    case BlendFactor::zero:
      return 0;
    case BlendFactor::one:
      return one;
    case BlendFactor::src_color:
      return value(s[i]);
    case BlendFactor::one_minus_src_color:
      return one - value(s[i]);
    case BlendFactor::dst_color:
      return value(d[i]);
    case BlendFactor::one_minus_dst_color:
      return one - value(d[i]);
    case BlendFactor::src_alpha:
      return value(s[3]);
    case BlendFactor::one_minus_src_alpha:
      return one - value(s[3]);
    case BlendFactor::dst_alpha:
      return value(d[3]);
    case BlendFactor::one_minus_dst_alpha:
      return one - value(d[3]);
    case BlendFactor::src_alpha_saturate:
      return i == 3 ? one : std::min(value(s[3]), one - value(d[3]));
  }
  return 0;
}

unsigned combined(raster::LogicOp op, unsigned s, unsigned d) {
  switch (op) {
    case raster::LogicOp::clear:
      return 0;
    case raster::LogicOp::and_:
      return s & d;
    case raster::LogicOp::and_reverse:
      return s & ~d;
    case raster::LogicOp::copy:
      return s;
    case raster::LogicOp::and_inverted:
      return ~s & d;
    case raster::LogicOp::noop:
      return d;
    case raster::LogicOp::xor_:
      return s ^ d;
    case raster::LogicOp::or_:
      return s | d;
    case raster::LogicOp::nor:
      return ~(s | d);
    case raster::LogicOp::equiv:
      return ~(s ^ d);
    case raster::LogicOp::invert:
      return ~d;
    case raster::LogicOp::or_reverse:
      return s | ~d;
    case raster::LogicOp::copy_inverted:
      return ~s;
    case raster::LogicOp::or_inverted:
      return ~s | d;
    case raster::LogicOp::nand:
      return ~(s & d);
    case raster::LogicOp::set:
      break;
  }
  return ~0u;
}

}  // namespace

Rgba environment(EnvMode mode, BaseFormat format, const Rgba& f, const Rgba& t, const Rgba& c) {
  const bool has_color = format != BaseFormat::alpha;
  const bool has_alpha = format != BaseFormat::luminance && format != BaseFormat::rgb;
  Rgba out = f;
  if (mode == EnvMode::decal) {
    // Defined for RGB and RGBA only.
    for (size_t i = 0; i < 3; ++i)
      out[i] = format == BaseFormat::rgb ? t[i] : f[i] * (1 - t[3]) + t[i] * t[3];
    return out;
  }
  if (has_color) {
    for (size_t i = 0; i < 3; ++i) out[i] = combine(mode, f[i], t[i], c[i]);
  }
  // BLEND multiplies alpha, except for INTENSITY.
  const bool blends_alpha = format == BaseFormat::intensity;
  if (has_alpha)
    out[3] = combine(mode == EnvMode::blend && !blends_alpha ? EnvMode::modulate : mode, f[3], t[3], c[3]);
  return out;
}

bool compare(CompareFunc func, long double value, long double reference) {
  switch (func) {
    case CompareFunc::never:
      return false;
    case CompareFunc::less:
      return value < reference;
    case CompareFunc::equal:
      return value == reference;
    case CompareFunc::less_equal:
      return value <= reference;
    case CompareFunc::greater:
      return value > reference;
    case CompareFunc::not_equal:
      return value != reference;
    case CompareFunc::greater_equal:
      return value >= reference;
    case CompareFunc::always:
      return true;
  }
  return false;
}

uint8_t blend(const raster::BlendState& state, const uint8_t s[4], const uint8_t d[4], int component) {
  if (!state.enabled) return s[component];
  const size_t k = size_t(component);
  // In units of 1/255^2; 255 is odd, so there are no ties to break.
  const int sum = s[k] * factor(state.src, s, d, k, 255) + d[k] * factor(state.dst, s, d, k, 255);
  return uint8_t(std::min((sum + 127) / 255, 255));
}

long double blended_level(const raster::BlendState& state, const std::array<uint8_t, 4>& s,
                          const std::array<uint8_t, 4>& d, size_t k) {
  const int sum = s[k] * factor(state.src, s, d, k, 255) + d[k] * factor(state.dst, s, d, k, 255);
  return static_cast<long double>(std::min(sum, 255 * 255)) / 255;
}

long double blended(const raster::BlendState& state, const Rgba& s, const Rgba& d, size_t k) {
  const long double sum = s[k] * factor(state.src, s, d, k, 1.0L) + d[k] * factor(state.dst, s, d, k, 1.0L);
  return sum < 0 ? 0 : sum > 1 ? 1 : sum;
}

uint8_t combine_bits(raster::LogicOp op, uint8_t s, uint8_t d) { return uint8_t(combined(op, s, d) & 255u); }

long double combine_wide(raster::LogicOp op, long double s, long double d) {
  const auto bits = [](long double v) { return unsigned(v * 65535 + 0.5L); };
  return (combined(op, bits(s), bits(d)) & 65535u) / 65535.0L;
}

}  // namespace halfspace::oracle
