// Memory of a tile's packets: primitives that are ready to be drawn, one after the other. Plain, for the
// per-ISA kernels.
#pragma once

#include <cstddef>
#include <cstdint>

namespace halfspace::raster {

// Where a tile's next packet goes. At the limit a run has to be opened first.
struct PacketBin {
  std::byte *next = nullptr, *limit = nullptr;
};

// Packets of one draw on one tile that follow each other in memory.
struct PacketRun {
  std::byte* packets;
  uint32_t bytes, tile;
};

}  // namespace halfspace::raster
