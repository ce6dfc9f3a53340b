// Which pixel centres a snapped box holds, and which tiles those lie in.
#pragma once

#include <algorithm>
#include <cstdint>

#include "raster/primitive/segment.h"

namespace halfspace::raster {

// Pixel i has its centre at i * 256 + 128. First pixel with a centre >= v, and last with a centre <= v.
inline int first_pixel(int32_t v) { return (v + (kSubpixelScale / 2 - 1)) >> kSubpixelBits; }
inline int last_pixel(int32_t v) { return (v - kSubpixelScale / 2) >> kSubpixelBits; }

// Pixels of `bounds` whose centres lie in [x0, x1] x [y0, y1] (16.8, closed).
inline Rect pixel_box(int32_t x0, int32_t y0, int32_t x1, int32_t y1, const Rect& bounds) {
  return intersect({first_pixel(x0), first_pixel(y0), last_pixel(x1) + 1, last_pixel(y1) + 1}, bounds);
}

inline void push_to_bin(Segment& segment, size_t tile, uint32_t primitive) {
  std::vector<uint32_t>& bin = segment.bins[tile];
  if (bin.empty()) segment.touched.push_back(uint32_t(tile));
  bin.push_back(primitive);
}

inline void push_to_bin(Segment& segment, int tile_x, int tile_y, uint32_t primitive) {
  push_to_bin(segment, size_t(tile_y) * size_t(segment.tiles_x) + size_t(tile_x), primitive);
}

// Tiles of a pixel box: inclusive.
struct TileBox {
  int x0, y0, x1, y1;
};
inline TileBox tile_box(const Rect& pixels) {
  return {pixels.x0 / kTileSize, pixels.y0 / kTileSize, (pixels.x1 - 1) / kTileSize,
          (pixels.y1 - 1) / kTileSize};
}

// A bin entry in every tile of the box.
inline void bin_box(Segment& segment, const TileBox& box, uint32_t primitive) {
  for (int ty = box.y0; ty <= box.y1; ++ty) {
    for (int tx = box.x0; tx <= box.x1; ++tx) push_to_bin(segment, tx, ty, primitive);
  }
}

// A bin entry in every tile of the box that holds a pixel centre inside or on all three edges of the
// counter-clockwise or clockwise triangle.
void bin_triangle(Segment& segment, const TileBox& box, const int32_t x[3], const int32_t y[3],
                  uint32_t primitive);

}  // namespace halfspace::raster
