// Pixels of whole blocks to plain rows, as fast as memory takes them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "raster/surface/framebuffer.h"

namespace halfspace::raster {

// A stretch of eight rows that takes whole blocks, neighbours in memory as in the picture.
struct BlockRun {
  const uint32_t* pixels;  // of the first block's lowest row; null: all of them hold one cleared colour
  uint32_t value;          // that colour
  int blocks;
};

// A block that begins `at` pixels from where the rows of memory do.
struct PlacedBlock {
  const uint32_t* pixels;
  ptrdiff_t at;
};

// Rows of memory, `step` pixels apart; less than 0: downwards.
struct PixelRows {
  uint32_t* first;
  ptrdiff_t step;
};

struct RowFunctions {
  // Runs that follow each other, row by row from end to end: memory likes its rows whole.
  void (*write_runs)(const BlockRun* runs, int count, const PixelRows& out);
  // Eight rows of one colour, and over it what was drawn.
  void (*write_over)(uint32_t value, int width, const PlacedBlock* blocks, int count, const PixelRows& out);
  // `width` times the same.
  void (*fill_row)(uint32_t value, int width, uint32_t* to);
  // The plane's depth in a tile's blocks that `blocks` are the bits of.
  void (*fill_depth)(const DepthPlane& plane, uint64_t blocks, uint32_t* tile);
};
// Those of the level in use.
RowFunctions row_functions();

}  // namespace halfspace::raster
