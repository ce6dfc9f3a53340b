// The memory of points and lines that wait for their tiles as packets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "raster/arena.h"
#include "raster/primitive/packet_bin.h"

namespace halfspace::raster {

// A tile's memory comes in pieces of a few packets each: as little of it is taken, and so stays in the cache,
// however they are spread.
class PacketBins {
 public:
  // Once a draw, before the first run is opened. `largest`: of its packets, in bytes. `in_piece`: as many of
  // them come in a piece of memory.
  void start_draw(size_t tile_count, size_t largest, size_t in_piece) {
    if (bins_.size() != tile_count) bins_.resize(tile_count), pieces_.resize(tile_count);
    first_run_ = runs.size();
    largest_ = largest;
    piece_bytes_ = in_piece * largest;
  }
  size_t largest() const { return largest_; }
  PacketBin* bins() { return bins_.data(); }
  // Opens a run for the tile, whose bin has no room left: gives its index.
  uint32_t open(uint32_t tile);
  // Has what comes next open another run: something else is drawn on the tile before it.
  void close(uint32_t tile) { bins_[tile].limit = bins_[tile].next; }
  // Ends the runs of the draw, and gives how many bytes are in them.
  size_t finish_draw();
  void clear();
  const Arena& memory() const { return memory_; }

  std::vector<PacketRun> runs;

 private:
  struct Piece {
    std::byte* end = nullptr;
    size_t run = 0;  // the last, plus one
  };
  std::vector<PacketBin> bins_;
  std::vector<Piece> pieces_;
  size_t first_run_ = 0;  // of the draw
  size_t largest_ = 0, piece_bytes_ = 0;
  Arena memory_;
};

}  // namespace halfspace::raster
