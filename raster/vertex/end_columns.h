// Both ends of lines, shaded, a column a value. Plain, for the per-ISA kernels.
#pragma once

#include <cstdint>

#include "raster/vertex/effect_columns.h"

namespace halfspace::raster {

// What VertexHead and the attributes of a draw with colours, and no more, hold. Lines beyond the last one
// have values that can be computed with.
struct alignas(64) EndColumns {
  static constexpr uint32_t kMost = kVertexGroup;  // lines
  struct alignas(64) End {
    int32_t x[kMost], y[kMost];
    double z[kMost], inv_w[kMost];
    float rest_x[kMost], rest_y[kMost];
    float color[4][kMost];
    uint64_t outcode[kMost];  // where not all are inside
  };
  End end[2];
  bool all_inside;  // every outcode is zero
};

}  // namespace halfspace::raster
