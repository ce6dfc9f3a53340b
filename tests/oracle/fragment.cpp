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

// Factors in levels of 255.
int factor(BlendFactor f, const uint8_t s[4], const uint8_t d[4], int component) {
  const int i = component;
  switch (f) {
    case BlendFactor::zero:
      return 0;
    case BlendFactor::one:
      return 255;
    case BlendFactor::src_color:
      return s[i];
    case BlendFactor::one_minus_src_color:
      return 255 - s[i];
    case BlendFactor::dst_color:
      return d[i];
    case BlendFactor::one_minus_dst_color:
      return 255 - d[i];
    case BlendFactor::src_alpha:
      return s[3];
    case BlendFactor::one_minus_src_alpha:
      return 255 - s[3];
    case BlendFactor::dst_alpha:
      return d[3];
    case BlendFactor::one_minus_dst_alpha:
      return 255 - d[3];
    case BlendFactor::src_alpha_saturate:
      return component == 3 ? 255 : std::min<int>(s[3], 255 - d[3]);
  }
  return 0;
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
  // In units of 1/255^2; 255 is odd, so there are no ties to break.
  const int sum =
      s[component] * factor(state.src, s, d, component) + d[component] * factor(state.dst, s, d, component);
  return uint8_t(std::min((sum + 127) / 255, 255));
}

}  // namespace halfspace::oracle
