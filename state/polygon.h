// Polygon rasterisation state (spec 3.5).
#pragma once

#include "state/gl_types.h"

namespace halfspace::state {

struct PolygonState {
  bool cull = false;
  GLenum cull_face = GL_BACK;
  GLenum front_face = GL_CCW;
  GLenum mode[2] = {GL_FILL, GL_FILL};  // front, back
};

}  // namespace halfspace::state
