// Viewport and depth range (spec 2.10.1).
#pragma once

#include "state/gl_types.h"

namespace halfspace::state {

struct ViewportState {
  int x = 0, y = 0, width = 0, height = 0;  // pixels
  double depth_near = 0, depth_far = 1;     // in [0, 1]
};

}  // namespace halfspace::state
