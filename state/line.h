// Line rasterisation state (spec 3.4).
#pragma once

#include "state/gl_types.h"

namespace halfspace::state {

struct LineState {
  float width = 1;  // as given: what is drawn is clamped and rounded by the renderer
  bool smooth = false;
  bool stipple = false;
  GLushort pattern = 0xffff;
  GLint repeat = 1;  // 1 .. 256
};

}  // namespace halfspace::state
