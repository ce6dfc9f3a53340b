// Point rasterisation state (spec 3.3).
#pragma once

namespace halfspace::state {

struct PointState {
  float size = 1;  // as given: what is drawn is clamped and rounded by the renderer
  bool smooth = false;
};

}  // namespace halfspace::state
