// The true picture of a recorded scene: which primitive owns a pixel, exactly, and its colour before any
// rounding to bytes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tests/differential/recording.h"
#include "tests/differential/true_triangle.h"

namespace halfspace::differential {

// Primitives are counted from 1 through all draws of a frame, as they come; 0 is the background.
using Owner = uint32_t;

struct Truth {
  int width = 0, height = 0;
  std::vector<Owner> owner;                  // row 0 is the bottom row
  std::vector<std::array<double, 4>> color;  // R, G, B, A in levels, 0 .. 255
  // Distance of an owned pixel's centre to its triangle's nearest edge, in pixels; 0 for the background.
  std::vector<float> edge_distance;
  std::vector<uint16_t> draw;  // the owner's draw, counted from 1; 0 is the background

  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  }
  // The pixel and its eight neighbours belong to one draw (one mesh): nothing but shading is to be seen.
  bool interior(int x, int y) const;
};

Truth true_picture(const Recording& recording, Positions positions = Positions::snapped);

// What textures with GL_LINEAR and GL_REPEAT give (spec 3.8.8, equation 3.24), each component in 0 .. 1.
std::array<Real, 4> filtered(const ref_app::Image& image, Real s, Real t);

}  // namespace halfspace::differential
