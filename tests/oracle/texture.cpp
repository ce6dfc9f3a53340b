#include "tests/oracle/texture.h"

#include <algorithm>
#include <cmath>

namespace halfspace::oracle {

using raster::Filter;
using raster::MipMode;
using raster::Wrap;

Rgba Level::texel(int i, int j) const {
  const size_t pitch = size_t(width + 2 * border);
  const uint8_t* p = &rgba[4 * (size_t(j + border) * pitch + size_t(i + border))];
  return {p[0] / 255.0L, p[1] / 255.0L, p[2] / 255.0L, p[3] / 255.0L};
}

namespace {

// Spec 3.8.7: REPEAT ignores the integer part; CLAMP clamps to [0, 1]; CLAMP_TO_EDGE to [1/2N, 1 - 1/2N].
long double wrap(Wrap mode, long double s, int size) {
  const long double half = 0.5L / size;
  switch (mode) {
    case Wrap::repeat:
      return s - std::floor(s);
    case Wrap::clamp:
      return std::clamp(s, 0.0L, 1.0L);
    case Wrap::clamp_to_edge:
      return std::clamp(s, half, 1 - half);
  }
  return s;
}

// Equations 3.20, 3.21: s = 1 (which only clamping lets through) is the last texel. The house takes u to the
// nearest 1/1024 of a texel first, so that s = k / N, which as a float may lie below texel k, finds it.
int nearest_texel(long double u, int size, Wrap mode) {
  const int texel = int(std::floor(std::floor(u * 1024 + 0.5L) / 1024));
  return std::clamp(texel < size ? texel : mode == Wrap::repeat ? 0 : size - 1, 0, size - 1);
}

// The texels that a coordinate may be taken to lie in which is off by a quarter of that.
std::array<int, 2> nearest_texels(long double u, int size, Wrap mode) {
  constexpr long double kTexelDoubt = 1.0L / 4096;
  return {nearest_texel(u - kTexelDoubt, size, mode), nearest_texel(u + kTexelDoubt, size, mode)};
}

// A colour as a texel of that format holds it, with 8 bits a component (spec tables 3.15 and 3.21).
Rgba stored_border(const raster::Color& border, raster::BaseFormat format) {
  const auto stored = [](float c) {
    return std::floor(std::clamp(static_cast<long double>(c), 0.0L, 1.0L) * 255 + 0.5L) / 255;
  };
  const long double r = stored(border.r), a = stored(border.a);
  switch (format) {
    case raster::BaseFormat::alpha:
      return {0, 0, 0, a};
    case raster::BaseFormat::luminance:
      return {r, r, r, 1};
    case raster::BaseFormat::luminance_alpha:
      return {r, r, r, a};
    case raster::BaseFormat::intensity:
      return {r, r, r, r};
    case raster::BaseFormat::rgb:
      return {r, stored(border.g), stored(border.b), 1};
    case raster::BaseFormat::rgba:
      break;
  }
  return {r, stored(border.g), stored(border.b), a};
}

// Spec 3.8.8: "If any of the selected texels refers to a border texel that has not been defined, the border
// color is used." It is stored, as texels are, with 8 bits.
Rgba texel_or_border(const Texture& texture, const Level& level, int i, int j) {
  const auto outside = [&level](int k, int size) { return k < -level.border || k >= size + level.border; };
  if (!outside(i, level.width) && !outside(j, level.height)) return level.texel(i, j);
  return stored_border(texture.sampler.border_color, texture.base_format);
}

int modulo(int i, int size) { return ((i % size) + size) % size; }

Rgba mix(const Rgba& a, const Rgba& b, long double f) {
  Rgba mixed;
  for (size_t c = 0; c < 4; ++c) mixed[c] = (1 - f) * a[c] + f * b[c];
  return mixed;
}

// Equations 3.22 - 3.24.
Rgba bilinear(const Texture& texture, const Level& level, long double u, long double v) {
  int i = int(std::floor(u - 0.5L)), j = int(std::floor(v - 0.5L));
  int i1 = i + 1, j1 = j + 1;
  const long double alpha = u - 0.5L - i, beta = v - 0.5L - j;
  if (texture.sampler.wrap_s == Wrap::repeat) i = modulo(i, level.width), i1 = modulo(i1, level.width);
  if (texture.sampler.wrap_t == Wrap::repeat) j = modulo(j, level.height), j1 = modulo(j1, level.height);
  return mix(mix(texel_or_border(texture, level, i, j), texel_or_border(texture, level, i1, j), alpha),
             mix(texel_or_border(texture, level, i, j1), texel_or_border(texture, level, i1, j1), alpha),
             beta);
}

}  // namespace

Rgba sample_level(const Texture& texture, int index, Filter filter, long double s, long double t,
                  bool* doubtful) {
  const Level& level = texture.levels[size_t(index)];
  const long double u = wrap(texture.sampler.wrap_s, s, level.width) * level.width;
  const long double v = wrap(texture.sampler.wrap_t, t, level.height) * level.height;
  if (filter == Filter::linear) return bilinear(texture, level, u, v);
  const Wrap wrap_s = texture.sampler.wrap_s, wrap_t = texture.sampler.wrap_t;
  const Rgba texel =
      level.texel(nearest_texel(u, level.width, wrap_s), nearest_texel(v, level.height, wrap_t));
  for (const int i : nearest_texels(u, level.width, wrap_s))
    for (const int j : nearest_texels(v, level.height, wrap_t))
      if (doubtful && level.texel(i, j) != texel) *doubtful = true;
  return texel;
}

namespace {

constexpr long double kLevelDoubt = 1.0L / 64;  // NUMERICS: the level of detail may be off by this

// Equation 3.19: the longer of the two gradients of (u, v), in texels per pixel. A one-dimensional texture
// has no v.
long double scale_factor(const Texture& texture, const Affine<long double>& s, const Affine<long double>& t) {
  const Level& base = texture.levels[0];
  const long double height = texture.sampler.one_dimensional ? 0 : base.height;
  return std::max(std::hypot(s.dx * base.width, t.dx * height), std::hypot(s.dy * base.width, t.dy * height));
}

bool is_near(long double a, long double b) { return std::fabs(a - b) < kLevelDoubt; }

// Spec 3.8.8: by MipMode::nearest, equation 3.25; by linear, equations 3.26 - 3.28.
Rgba minified(const Texture& texture, long double s, long double t, Lookup& result) {
  const raster::Sampler& sampler = texture.sampler;
  const int last = int(texture.levels.size()) - 1;
  const auto level = [&](int d) { return sample_level(texture, d, sampler.min, s, t, &result.doubtful); };
  const long double lod = std::min(result.lod, 64.0L);
  if (sampler.mip == MipMode::none) return level(0);
  if (sampler.mip == MipMode::nearest) {
    const int d = lod <= 0.5L ? 0 : int(std::ceil(lod + 0.5L)) - 1;
    result.doubtful |= d <= last && is_near(lod + 0.5L, std::floor(lod + 1));
    return level(std::min(d, last));
  }
  const int d = std::clamp(int(std::floor(lod)), 0, last);
  return d == last ? level(last) : mix(level(d), level(d + 1), std::max(lod, 0.0L) - d);
}

}  // namespace

Lookup sample(const Texture& texture, const Affine<long double>& s, const Affine<long double>& t) {
  const raster::Sampler& sampler = texture.sampler;
  Lookup result;
  result.lod = std::log2(scale_factor(texture, s, t));
  // Spec 3.8.9, the switch-over point.
  const bool half =
      sampler.mag == Filter::linear && sampler.min == Filter::nearest && sampler.mip != MipMode::none;
  const long double switch_over = half ? 0.5L : 0.0L;
  result.magnified = result.lod <= switch_over;
  if (!std::isfinite(s.value) || !std::isfinite(t.value)) {
    result.doubtful = true;  // a coordinate of nothing
    return result;
  }
  const bool alike =
      sampler.mag == sampler.min && (sampler.mip != MipMode::nearest || texture.levels.size() == 1);
  result.doubtful = !alike && is_near(result.lod, switch_over);
  result.color = result.magnified ? sample_level(texture, 0, sampler.mag, s.value, t.value, &result.doubtful)
                                  : minified(texture, s.value, t.value, result);
  return result;
}

}  // namespace halfspace::oracle
