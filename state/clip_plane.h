// User clip planes (spec 2.11).
#pragma once

#include <array>

#include "raster/api/clip_plane.h"

namespace halfspace::state {

struct ClipPlaneState {
  bool enabled[raster::kMaxClipPlanes] = {};
  // In eye coordinates: taken there by the modelview of when they were given.
  std::array<std::array<double, 4>, raster::kMaxClipPlanes> planes{};
};

}  // namespace halfspace::state
