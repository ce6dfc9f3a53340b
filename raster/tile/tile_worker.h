// A worker: takes a tile through all its primitives, in order.
#pragma once

#include <span>

#include "raster/fragment/program.h"
#include "raster/primitive/segment.h"
#include "raster/surface/framebuffer.h"
#include "raster/view.h"

namespace halfspace::raster {

struct TileStatistics {
  uint64_t fragments = 0, double_fragments = 0;
  StageMeter* meter = nullptr;  // where stages are counted, or null
  PixelNote* notes = nullptr;   // of the tile's pixels, for a view of them, or null
};

inline constexpr uint32_t kNoTile = ~uint32_t{0};

// Draws the bins of `tile` of all segments, in their order, on the framebuffer. Tiles are independent of each other.
// `next`: what the same thread will draw after it, or kNoTile.
void run_tile(std::span<Segment* const> segments, Framebuffer::Impl& framebuffer, uint32_t tile, uint32_t next,
              TileStatistics& statistics);

}  // namespace halfspace::raster
