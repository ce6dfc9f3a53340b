// What happens to a fragment after the texture lookup: environment, alpha test, blending, storing.
#pragma once

#include <array>
#include <cstdint>

#include "raster/api/draw_state.h"
#include "tests/oracle/texture.h"

namespace halfspace::oracle {

// Spec 3.8.13, tables 3.22 and 3.23.
Rgba environment(raster::EnvMode mode, raster::BaseFormat format, const Rgba& fragment, const Rgba& texture,
                 const Rgba& constant);

bool compare(raster::CompareFunc func, long double value, long double reference);

// Spec 4.1.7, in levels of 255: one component of source times factor plus destination times factor, clamped
// and rounded once, to nearest. s, d: the pixels' R, G, B, A in 0 .. 255; `component` 0 .. 3.
uint8_t blend(const raster::BlendState& state, const uint8_t s[4], const uint8_t d[4], int component);

// The same before rounding.
long double blended_level(const raster::BlendState& state, const std::array<uint8_t, 4>& s,
                          const std::array<uint8_t, 4>& d, size_t component);
// Spec 4.1.7 for a buffer of floats: colours in [0, 1], clamped and not rounded.
long double blended(const raster::BlendState& state, const Rgba& s, const Rgba& d, size_t component);

// Spec 4.1.10, table 4.4, on the bits of bytes; and on a float buffer's values as 16-bit integers.
uint8_t combine_bits(raster::LogicOp op, uint8_t s, uint8_t d);
long double combine_wide(raster::LogicOp op, long double s, long double d);

// Spec 2.13.9: the nearest of 0 .. 255, unrounded (so that a test can ask how far a byte is off).
inline long double level_of(long double c) { return (c < 0 ? 0 : c > 1 ? 1 : c) * 255; }

}  // namespace halfspace::oracle
