// Shading and materials (spec 2.14). Materials are kept; lighting does not use them yet.
#pragma once

#include "state/gl_types.h"

namespace halfspace::state {

struct MaterialState {
  float ambient[4] = {0.2f, 0.2f, 0.2f, 1};
  float diffuse[4] = {0.8f, 0.8f, 0.8f, 1};
  float specular[4] = {0, 0, 0, 1};
  float emission[4] = {0, 0, 0, 1};
  float shininess = 0;                 // 0 .. 128
  float color_indexes[3] = {0, 1, 1};  // ambient, diffuse, specular
};

struct LightingState {
  GLenum shade_model = GL_SMOOTH;
  MaterialState material[2];  // front, back
};

}  // namespace halfspace::state
