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

// Two ends in 16.8 window coordinates.
struct LineEnds {
  int32_t x0, y0, x1, y1;
};

// Pixels of a tile one by one, each once, relative to the tile.
struct PixelList {
  uint8_t x[kTileSize], y[kTileSize];
  int count;
};

// Where along a line there are fragments (spec 3.4.2, 3.4.2.2): bit s / repeat % 16 of the pattern, s
// counting fragments from `start` on; for smooth lines s is 256ths of a pixel's length of the line.
struct LineStipple {
  bool on = false;
  uint16_t pattern = 0xffff;
  int repeat = 1;
  uint32_t start = 0;
};

// A line by the diamond-exit rule (spec 3.4.1): a fragment for each diamond the segment leaves; the end
// point's own diamond makes none. Half-open, so a strip draws each vertex once. Wider than 1, it is moved by
// (width - 1) / 2 along the minor axis, and each fragment becomes `width` of them there. (tile_x, tile_y):
// the tile's lowest pixel. Only pixels of `bounds` are made, and where the middle of the line lies in
// `middle`.
void cover_line(const LineEnds& ends, int width, const LineStipple& stipple, int tile_x, int tile_y,
                const Rect& bounds, const Rect& middle, TileCoverage& out);

// The same for a line of width 1, which has at most one fragment in a column or, where it is steep, in a row:
// what raster/tile/lines.inl draws it by, a vector of columns at a time.
void list_line(const LineEnds& ends, int tile_x, int tile_y, const Rect& bounds, PixelList& out);

// The fragments of a line (columns of a wide one): how many there are, and the coordinate of the first one
// along the longer axis; the others follow in the direction of the line.
struct LineRun {
  int first;
  uint32_t count;
};
LineRun line_run(const LineEnds& ends, int width);

// The pixels of a point of `size` (spec 3.3): around the middle of the pixel it lies in where that is odd,
// around the nearest corner of pixels where it is even.
Rect point_square(int32_t x, int32_t y, int size);
void cover_point(int32_t x, int32_t y, int size, int tile_x, int tile_y, const Rect& bounds,
                 TileCoverage& out);

}  // namespace halfspace::raster
