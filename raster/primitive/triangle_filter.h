// Which of a draw's triangles can cover a pixel, eight at once: most of a fine mesh's cannot, and every step
// they do not take is one saved.
#pragma once

#include <cstddef>
#include <cstdint>

#include "raster/api/types.h"

namespace halfspace::raster {

inline constexpr uint32_t kFilterLanes = 8;

struct TriangleFilter {
  const std::byte* records;  // of shaded vertices
  size_t stride;
  uint32_t base;  // what corners are counted from
  const uint16_t* outcodes;
  Rect bounds;               // the draw's
  bool cull_clockwise, cull_counter_clockwise;
  int tiles_x;  // of a row
};

// One bit a lane, and what is known of the lanes of `kept`.
struct FilteredTriangles {
  uint32_t kept;     // may cover a pixel centre within the bounds
  uint32_t special;  // a corner lies outside of something: nothing was decided
  uint32_t clockwise;
  uint32_t dropped;      // how many are neither kept nor special
  uint32_t in_one_tile;  // have all pixels to look at in one tile:
  int32_t tile[kFilterLanes];
  int32_t tile_x0[kFilterLanes], tile_y0[kFilterLanes];  // tiles to look at,
  int32_t tile_x1[kFilterLanes], tile_y1[kFilterLanes];  // inclusive
  int32_t x[3][kFilterLanes], y[3][kFilterLanes];        // corners, 16.8
};

// corners: three vertices for each of `count` <= kFilterLanes triangles. Drops the culled, those without
// area, those whose box holds no pixel centre, and those of a few pixels' size that have none inside.
using TriangleFilterFunction = void (*)(const TriangleFilter& filter, const uint32_t* corners, uint32_t count,
                                        FilteredTriangles& out);
TriangleFilterFunction triangle_filter();

}  // namespace halfspace::raster
