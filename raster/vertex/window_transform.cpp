#include "raster/vertex/window_transform.h"

#include <algorithm>
#include <cmath>

namespace halfspace::raster {

WindowTransform make_window_transform(const Viewport& viewport) {
  WindowTransform t{};
  // Integers of at most 32 bits, so every product here is exact.
  t.scale_x = double(viewport.width) * (kSubpixelScale / 2);
  t.scale_y = double(viewport.height) * (kSubpixelScale / 2);
  t.offset_x = double(viewport.x) * kSubpixelScale + t.scale_x;
  t.offset_y = double(viewport.y) * kSubpixelScale + t.scale_y;
  t.depth_scale = (viewport.depth_far - viewport.depth_near) * 0.5;
  t.depth_offset = (viewport.depth_far + viewport.depth_near) * 0.5;
  t.depth_low = std::min(viewport.depth_near, viewport.depth_far);
  t.depth_high = std::max(viewport.depth_near, viewport.depth_far);
  t.inside_guard = viewport.x >= kGuardBandMin && int64_t(viewport.x) + viewport.width <= kGuardBandMax &&
                   viewport.y >= kGuardBandMin && int64_t(viewport.y) + viewport.height <= kGuardBandMax;
  return t;
}

int32_t snap_coordinate(double clip, double w, double scale, double offset) {
  const double v = std::floor(clip / w * scale + 0.5) + offset;
  const double low = double(kGuardBandMin) * kSubpixelScale;
  const double high = double(kGuardBandMax) * kSubpixelScale - 1;
  if (!(v > low)) return int32_t(low);  // NaN too
  return int32_t(v < high ? v : high);
}

}  // namespace halfspace::raster
