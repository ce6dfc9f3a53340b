// The memory of points that wait for their tiles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "raster/arena.h"
#include "raster/primitive/point_packet.h"

namespace halfspace::raster {

// A tile's memory comes in pieces of a few packets each: as little of it is taken, and so stays in the cache,
// however the points are spread.
class PointBins {
 public:
  // Once a draw, before the first run is opened.
  void start_draw(size_t tile_count) {
    if (bins_.size() != tile_count) bins_.resize(tile_count), pieces_.resize(tile_count);
    first_run_ = runs.size();
  }
  PointBin* bins() { return bins_.data(); }
  // Opens a run for the tile, whose bin is at its limit: gives its index.
  uint32_t open(uint32_t tile);
  // Ends the runs of the draw, and gives how many points are in them.
  size_t finish_draw();
  void clear();

  std::vector<PointRun> runs;

 private:
  static constexpr size_t kPiece = 32;  // packets; measured best of 16, 32 and 64
  struct Piece {
    PointPacket* end = nullptr;
    size_t run = 0;  // the last, plus one
  };
  std::vector<PointBin> bins_;
  std::vector<Piece> pieces_;
  size_t first_run_ = 0;  // of the draw
  Arena memory_;
};

}  // namespace halfspace::raster
