// The true picture of a recorded scene: which primitive owns a pixel, exactly, and its colour before any
// rounding to bytes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "tests/differential/recording.h"
#include "tests/differential/true_filter.h"
#include "tests/differential/true_triangle.h"

namespace halfspace::differential {

// Primitives are counted from 1 through all draws of a frame, as they come; 0 is the background.
using Owner = uint32_t;

struct Truth {
  int width = 0, height = 0;
  std::vector<Owner> owner;                  // row 0 is the bottom row
  std::vector<std::array<double, 4>> color;  // R, G, B, A in levels, 0 .. 255
  std::vector<uint16_t> draw;                // the owner's draw, counted from 1; 0 is the background

  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  }
  // The pixel and its eight neighbours belong to one draw (one mesh): nothing but shading is to be seen.
  bool interior(int x, int y) const;
};

// What is held to be true. The default is what the numeric contract asks of the standard level.
struct Model {
  Positions positions = kContract;
  Filter filter = Filter::exact;
};

Truth true_picture(const Recording& recording, const Model& model = {});

// From the pixel's centre to the nearest edge of that primitive, in pixels; none for the background.
std::optional<double> distance_to_edge(const Recording& recording, Owner owner, int x, int y);

}  // namespace halfspace::differential
