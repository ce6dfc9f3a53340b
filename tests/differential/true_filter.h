// Textures as GL_LINEAR and GL_REPEAT show them, in long double.
#pragma once

#include <array>
#include <cstdint>

#include "ref_app/gapi.h"
#include "tests/differential/true_triangle.h"

namespace halfspace::differential {

enum class Filter : uint8_t {
  exact,  // spec 3.8.8, equation 3.24
  // Coordinates to the nearest 1/256 texel, 8-bit weights, s before t, each step rounded to 8 bits: what
  // llvmpipe does by default and our draft level follows. Sides are powers of two.
  eight_bit,
};

// R, G, B, A in 0 .. 1.
std::array<Real, 4> sample(Filter filter, const ref_app::Image& image, Real s, Real t);

}  // namespace halfspace::differential
