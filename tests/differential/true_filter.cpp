#include "tests/differential/true_filter.h"

#include <cmath>

namespace halfspace::differential {
namespace {

// The two texels beside a coordinate along one axis.
struct Pair {
  size_t first, second;
};

Pair wrapped(int64_t first, int size) {
  const auto wrap = [size](int64_t i) { return static_cast<size_t>(((i % size) + size) % size); };
  return {wrap(first), wrap(first + 1)};
}

const uint8_t* texel(const ref_app::Image& image, size_t i, size_t j) {
  return &image.rgba[4 * (j * static_cast<size_t>(image.width) + i)];
}

std::array<Real, 4> sample_exactly(const ref_app::Image& image, Real s, Real t) {
  const Real u = (s - std::floor(s)) * image.width - 0.5L, v = (t - std::floor(t)) * image.height - 0.5L;
  const Real left = std::floor(u), low = std::floor(v), alpha = u - left, beta = v - low;
  const Pair i = wrapped(static_cast<int64_t>(left), image.width);
  const Pair j = wrapped(static_cast<int64_t>(low), image.height);
  const uint8_t *t00 = texel(image, i.first, j.first), *t10 = texel(image, i.second, j.first);
  const uint8_t *t01 = texel(image, i.first, j.second), *t11 = texel(image, i.second, j.second);
  std::array<Real, 4> color;
  for (size_t k = 0; k < 4; ++k) {
    color[k] = ((1 - alpha) * (1 - beta) * t00[k] + alpha * (1 - beta) * t10[k] +
                (1 - alpha) * beta * t01[k] + alpha * beta * t11[k]) /
               255;
  }
  return color;
}

int mix(int a, int b, int weight) { return a + ((weight * (b - a) + 128) >> 8); }

std::array<Real, 4> sample_in_eight_bits(const ref_app::Image& image, Real s, Real t) {
  // In 1/256 texel, from the middle of texel 0. Wrapping commutes with the rounding: a side is an integer.
  const auto fixed = [](Real coordinate, int size) {
    return static_cast<int64_t>(std::nearbyint(coordinate * size * 256)) - 128;
  };
  const int64_t u = fixed(s, image.width), v = fixed(t, image.height);
  const Pair i = wrapped(u >> 8, image.width), j = wrapped(v >> 8, image.height);
  const int alpha = static_cast<int>(u & 255), beta = static_cast<int>(v & 255);
  std::array<Real, 4> color;
  for (size_t k = 0; k < 4; ++k) {
    const int low = mix(texel(image, i.first, j.first)[k], texel(image, i.second, j.first)[k], alpha);
    const int high = mix(texel(image, i.first, j.second)[k], texel(image, i.second, j.second)[k], alpha);
    color[k] = static_cast<Real>(mix(low, high, beta)) / 255;
  }
  return color;
}

}  // namespace

std::array<Real, 4> sample(Filter filter, const ref_app::Image& image, Real s, Real t) {
  return filter == Filter::exact ? sample_exactly(image, s, t) : sample_in_eight_bits(image, s, t);
}

}  // namespace halfspace::differential
