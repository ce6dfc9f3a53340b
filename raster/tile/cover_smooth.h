// How much of each pixel a smooth point, line or polygon covers (spec 3.3.1, 3.4.2.3, 3.5.6): areas, in
// double.
#pragma once

#include <cstdint>

#include "raster/api/accuracy.h"
#include "raster/tile/coverage.h"

namespace halfspace::raster {

// Where a + b y + c >= 0 for all edges, x and y in pixels from the anchor. Both come from the primitive
// alone, so a pixel's coverage does not depend on the tile.
struct SmoothShape {
  struct Edge {
    double a, b, c;
  };
  int32_t anchor_x, anchor_y;  // 16.8
  Edge edges[4];
  int edge_count;
  double radius;  // > 0: a disc around the anchor instead
  // Of a line: edges 2 and 3 are its ends, edge 2 growing along it from 0 to its length.
  LineStipple stipple;
  double length;
  Rect box;  // pixels it may touch
  // draft: 16 samples a pixel; standard: areas, of discs by 16 rows; exact: areas.
  Level level = Level::standard;
};

SmoothShape smooth_triangle(const int32_t (&x)[3], const int32_t (&y)[3]);
// The rectangle `width` wide around the segment. Its ends must differ.
SmoothShape smooth_line(const LineEnds& ends, double width, const LineStipple& stipple);
SmoothShape smooth_point(int32_t x, int32_t y, double size);

// Coverage, in [0, 1], of the 8x8 pixels from (x, y) on, row by row; returns a bit for each pixel it is above
// 0.
uint64_t cover_block(const SmoothShape& shape, int x, int y, float (&coverage)[64]);

}  // namespace halfspace::raster
