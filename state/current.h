// Current vertex attributes (spec 2.7).
#pragma once

#include "state/gl_types.h"

namespace halfspace::state {

struct CurrentState {
  alignas(16) float color[4] = {1, 1, 1, 1};  // not clamped
  alignas(16) float tex_coord[4] = {0, 0, 0, 1};
  alignas(16) float normal[4] = {0, 0, 1, 0};  // the last is nothing
  bool edge_flag = true;
  float index = 1;  // kept and queried; an RGBA visual draws nothing with it
};

}  // namespace halfspace::state
