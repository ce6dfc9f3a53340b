// Frames that several workloads and scales are made of.
#pragma once

#include "bench/workload.h"

namespace halfspace::bench {

struct QuadStyle {
  bool tilted = true;
  bool four_colors = false;
  bool translucent = false;
  float first_depth = 0, last_depth = 0;  // -1 near .. 1 far
};
// Near full-screen quads over each other.
Frame draw_quads(int count, const QuadStyle& style);

// A terrain of cells by cells, two triangles each, with depth test.
Frame draw_terrain(int cells);

// Squares of two triangles in a grid, a texture bound and a matrix loaded before each.
Frame draw_small_squares(int count, int texture_count, Screen screen);

}  // namespace halfspace::bench
