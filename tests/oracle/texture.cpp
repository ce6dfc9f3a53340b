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

// Equations 3.20, 3.21: s = 1 (which only clamping lets through) is the last texel.
int nearest_texel(long double u, int size) { return std::min(int(std::floor(u)), size - 1); }

// Spec 3.8.8: "If any of the selected texels refers to a border texel that has not been defined, the border
// color is used." It is stored, as texels are, with 8 bits.
Rgba texel_or_border(const Texture& texture, const Level& level, int i, int j) {
  const auto outside = [&level](int k, int size) { return k < -level.border || k >= size + level.border; };
  if (!outside(i, level.width) && !outside(j, level.height)) return level.texel(i, j);
  const raster::Color& border = texture.sampler.border_color;
  const auto stored = [](float c) {
    return std::floor(std::clamp(static_cast<long double>(c), 0.0L, 1.0L) * 255 + 0.5L) / 255;
  };
  return {stored(border.r), stored(border.g), stored(border.b), stored(border.a)};
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

Rgba sample_level(const Texture& texture, int index, Filter filter, long double s, long double t) {
  const Level& level = texture.levels[size_t(index)];
  const long double u = wrap(texture.sampler.wrap_s, s, level.width) * level.width;
  const long double v = wrap(texture.sampler.wrap_t, t, level.height) * level.height;
  if (filter == Filter::linear) return bilinear(texture, level, u, v);
  return level.texel(nearest_texel(u, level.width), nearest_texel(v, level.height));
}

Lookup sample(const Texture& texture, const Affine<long double>& s, const Affine<long double>& t) {
  const raster::Sampler& sampler = texture.sampler;
  const Level& base = texture.levels[0];
  // Equation 3.19: the longer of the two gradients of (u, v), in texels per pixel.
  const long double rho = std::max(std::hypot(s.dx * base.width, t.dx * base.height),
                                   std::hypot(s.dy * base.width, t.dy * base.height));
  Lookup result;
  result.lod = std::log2(rho);
  // Spec 3.8.9, the switch-over point.
  const bool half =
      sampler.mag == Filter::linear && sampler.min == Filter::nearest && sampler.mip != MipMode::none;
  result.magnified = result.lod <= (half ? 0.5L : 0.0L);
  const int last = int(texture.levels.size()) - 1;
  const auto level = [&](int d) { return sample_level(texture, d, sampler.min, s.value, t.value); };
  if (result.magnified) {
    result.color = sample_level(texture, 0, sampler.mag, s.value, t.value);
  } else if (sampler.mip == MipMode::none) {
    result.color = level(0);
  } else if (sampler.mip == MipMode::nearest) {
    // Equation 3.25.
    const int d = result.lod <= 0.5L ? 0 : int(std::ceil(std::min(result.lod, 64.0L) + 0.5L)) - 1;
    result.color = level(std::min(d, last));
  } else {
    // Equations 3.26 - 3.28.
    const int d = std::min(int(std::floor(std::min(result.lod, 64.0L))), last);
    const int next = std::min(d + 1, last);
    result.color = d == last ? level(last) : mix(level(d), level(next), result.lod - d);
  }
  return result;
}

}  // namespace halfspace::oracle
