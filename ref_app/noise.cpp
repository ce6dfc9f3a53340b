#include "ref_app/noise.h"

namespace ref_app {
namespace {

// 6t^5 - 15t^4 + 10t^3: first and second derivative vanish at both ends.
float fade(float t) { return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F); }

// A slope through 0 in the lattice point (x, y), in a direction of its own, at (u, v) from it.
float ramp(uint32_t x, uint32_t y, uint32_t seed, float u, float v) {
  return (2.0F * hash_unit(x, y, seed) - 1.0F) * u + (2.0F * hash_unit(x, y, seed + 0x5EED) - 1.0F) * v;
}

}  // namespace

float gradient_noise(float x, float y, uint32_t period_x, uint32_t period_y, uint32_t seed) {
  const auto cell_x = static_cast<uint32_t>(x), cell_y = static_cast<uint32_t>(y);
  const float u = x - static_cast<float>(cell_x), v = y - static_cast<float>(cell_y);
  const uint32_t x0 = cell_x % period_x, x1 = (cell_x + 1) % period_x;
  const uint32_t y0 = cell_y % period_y, y1 = (cell_y + 1) % period_y;
  const float low = mix(ramp(x0, y0, seed, u, v), ramp(x1, y0, seed, u - 1, v), fade(u));
  const float high = mix(ramp(x0, y1, seed, u, v - 1), ramp(x1, y1, seed, u - 1, v - 1), fade(u));
  return clamp_unit(0.5F + 0.75F * mix(low, high, fade(v)));
}

float fractal_noise(float x, float y, uint32_t period, int octaves, uint32_t seed) {
  float sum = 0.0F, weights = 0.0F, weight = 1.0F;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += weight * gradient_noise(x, y, period, period, seed + static_cast<uint32_t>(octave));
    weights += weight;
    weight *= 0.45F;
    x *= 2.0F, y *= 2.0F, period *= 2;
  }
  return sum / weights;
}

float ridged_noise(float x, float y, uint32_t period, int octaves, uint32_t seed) {
  float sum = 0.0F, weights = 0.0F, weight = 1.0F;
  for (int octave = 0; octave < octaves; ++octave) {
    const float n = 2.0F * gradient_noise(x, y, period, period, seed + static_cast<uint32_t>(octave)) - 1.0F;
    const float ridge = 1.0F - (n < 0.0F ? -n : n);
    sum += weight * ridge * ridge;
    weights += weight;
    weight *= 0.45F;
    x *= 2.0F, y *= 2.0F, period *= 2;
  }
  return sum / weights;
}

}  // namespace ref_app
