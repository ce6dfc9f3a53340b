// Scissor test (spec 4.1.2).
#pragma once

#include "raster/api/types.h"
#include "state/gl_types.h"

namespace halfspace::state {

struct ScissorState {
  bool test = false;
  int x = 0, y = 0, width = 0, height = 0;  // pixels; x + width may lie beyond what an int holds
  raster::Rect rect() const;                // the same, saturated
};

}  // namespace halfspace::state
