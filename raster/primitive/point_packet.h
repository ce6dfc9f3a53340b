// Points of one pixel, ready to be fragments. Plain, for the per-ISA kernels.
#pragma once

#include <cstdint>

namespace halfspace::raster {

// The tile's worker need not look for the point's vertex in memory that another thread may have written.
struct PointPacket {
  int32_t offset;  // of the pixel in the tile's memory
  int32_t depth;   // 24 bits
  float color[4];  // 0..1; of draws whose colour varies
};

// Where a tile's next packet goes. At the limit a run has to be opened first.
struct PointBin {
  PointPacket *next = nullptr, *limit = nullptr;
};

// Packets of one draw on one tile that follow each other in memory.
struct PointRun {
  PointPacket* packets;
  uint32_t count, tile;
};

}  // namespace halfspace::raster
