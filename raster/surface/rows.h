// Pixels of whole blocks to plain rows, as fast as memory takes them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "raster/surface/framebuffer.h"

namespace halfspace::raster {

// Eight rows of a tile, block by block: where each block's rows begin and how far apart they are. A block
// that is only marked as cleared has one row for all.
struct TileBand {
  const uint32_t* block[8];
  int step[8];
};

// Rows of memory, `step` pixels apart; less than 0: downwards.
struct PixelRows {
  uint32_t* first;
  ptrdiff_t step;
};

struct RowFunctions {
  void (*copy_band)(const TileBand& band, const PixelRows& out);  // 8 rows of 64 pixels
  void (*fill_rows)(uint32_t value, int width, int rows, const PixelRows& out);
};
// Those of the level in use.
RowFunctions row_functions();

}  // namespace halfspace::raster
