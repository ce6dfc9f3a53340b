// Points of one pixel, ready to be fragments. Plain, for the per-ISA kernels.
#pragma once

#include <cstddef>
#include <cstdint>

#include "raster/primitive/packet_bin.h"

namespace halfspace::raster {

// What a point's packet holds: its colour for the fragment's stages, or where these only round it and store
// it, the pixel; with the fragment's depth, where that is tested, or without.
enum class PointKind : uint8_t { colored, pixel, tested_pixel };

// The tile's worker need not look for the point's vertex in memory that another thread may have written.
struct PointPacket {
  int32_t offset;  // of the pixel in the tile's memory
  int32_t depth;   // 24 bits
  float color[4];  // 0..1; of draws whose colour varies
};

struct PixelPoint {
  int32_t offset;
  uint32_t pixel;
};

struct TestedPixelPoint {
  int32_t offset;
  uint32_t pixel;
  int32_t depth;
};

inline constexpr size_t point_bytes(PointKind kind) {
  if (kind == PointKind::colored) return sizeof(PointPacket);
  return kind == PointKind::pixel ? sizeof(PixelPoint) : sizeof(TestedPixelPoint);
}

}  // namespace halfspace::raster
