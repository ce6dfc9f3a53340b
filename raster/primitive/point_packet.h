// Points of one pixel, ready to be fragments. Plain, for the per-ISA kernels.
#pragma once

#include <cstdint>

#include "raster/primitive/packet_bin.h"

namespace halfspace::raster {

// The tile's worker need not look for the point's vertex in memory that another thread may have written.
struct PointPacket {
  int32_t offset;  // of the pixel in the tile's memory
  int32_t depth;   // 24 bits
  float color[4];  // 0..1; of draws whose colour varies
};

}  // namespace halfspace::raster
