// User clip planes (spec 2.12), in eye coordinates: a point is kept where p . (x, y, z, w) >= 0.
#pragma once

#include <array>

#include "raster/api/types.h"

namespace halfspace::raster {

inline constexpr int kMaxClipPlanes = 6;

struct ClipPlaneState {
  uint8_t enabled = 0;  // bit i: plane i
  std::array<std::array<double, 4>, kMaxClipPlanes> planes{};
};

}  // namespace halfspace::raster
