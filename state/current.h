// Current vertex attributes (spec 2.7).
#pragma once

#include "state/gl_types.h"

namespace halfspace::state {

struct CurrentState {
  float color[4] = {1, 1, 1, 1};  // not clamped
  float tex_coord[4] = {0, 0, 0, 1};
  float normal[3] = {0, 0, 1};
  bool edge_flag = true;
  float index = 1;  // kept and queried; an RGBA visual draws nothing with it
};

}  // namespace halfspace::state
