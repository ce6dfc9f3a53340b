// Smooth pseudo-random functions from integer hashing and + - * / alone: the same bits on every machine.
#pragma once

#include <cstdint>

namespace ref_app {

// Scrambles two lattice coordinates and a seed into 32 bits.
inline uint32_t hash_lattice(uint32_t x, uint32_t y, uint32_t seed) {
  uint32_t h = x * 0x9E3779B1u + y * 0x85EBCA77u + seed * 0xC2B2AE3Du;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return h ^ (h >> 15);
}

// Uniform in [0, 1).
inline float hash_unit(uint32_t x, uint32_t y, uint32_t seed) {
  return static_cast<float>(hash_lattice(x, y, seed) >> 8) * (1.0F / 16777216.0F);
}

inline float clamp_unit(float x) { return x < 0.0F ? 0.0F : (x > 1.0F ? 1.0F : x); }
inline float mix(float a, float b, float t) { return a + (b - a) * t; }
inline float smooth_step(float edge0, float edge1, float x) {
  const float t = clamp_unit((x - edge0) / (edge1 - edge0));
  return t * t * (3.0F - 2.0F * t);
}
// For x >= 0.
inline float fraction(float x) { return x - static_cast<float>(static_cast<int>(x)); }
// A wave of period 1 with its maximum 1 at whole x and its minimum 0 half way between; x >= 0.
inline float smooth_wave(float x) {
  const float distance = fraction(x) < 0.5F ? fraction(x) : 1.0F - fraction(x);
  const float t = 1.0F - 2.0F * distance;
  return t * t * (3.0F - 2.0F * t);
}

// Gradient noise in [0, 1], 0.5 at the lattice points, with a continuous gradient; x, y >= 0; repeats after
// lattice cells.
float gradient_noise(float x, float y, uint32_t period_x, uint32_t period_y, uint32_t seed);
// `octaves` of it, each of twice the frequency and 0.45 of the weight of the one before; in [0, 1].
float fractal_noise(float x, float y, uint32_t period, int octaves, uint32_t seed);
// The same made of ridges: sharp crests, wide valleys.
float ridged_noise(float x, float y, uint32_t period, int octaves, uint32_t seed);

}  // namespace ref_app
