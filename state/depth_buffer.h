// Depth buffer state (spec 4.1.6, 4.2.2).
#pragma once

#include "state/gl_types.h"

namespace halfspace::state {

struct DepthBufferState {
  bool test = false;
  GLenum func = GL_LESS;
  bool write = true;
  double clear_value = 1;  // in [0, 1]
};

}  // namespace halfspace::state
