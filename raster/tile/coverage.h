// Which pixels of a tile a primitive makes fragments at. Exact, in integers.
#pragma once

#include <cstdint>

#include "raster/api/types.h"
#include "raster/primitive/segment.h"

namespace halfspace::raster {

// One bit a pixel: block b = (y / 8) * 8 + x / 8 of the tile, bit (y % 8) * 8 + x % 8, y up.
struct TileCoverage {
  uint64_t blocks[64];
  uint64_t touched;  // bit b: blocks[b] may be non-zero; the others are not initialised
};

// A line from (x0, y0) to (x1, y1), 16.8 window coordinates, width 1, by the diamond-exit rule (spec 3.4.1): a
// fragment for each diamond the segment leaves; the end point's own diamond makes none. Half-open, so a strip
// draws each vertex once. (tile_x, tile_y): the tile's lowest pixel; only pixels of `bounds` are made.
void cover_line(int32_t x0, int32_t y0, int32_t x1, int32_t y1, int tile_x, int tile_y, const Rect& bounds,
                TileCoverage& out);

// A point of size 1 (spec 3.3): the pixel that contains it.
void cover_point(int32_t x, int32_t y, int tile_x, int tile_y, const Rect& bounds, TileCoverage& out);

}  // namespace halfspace::raster
