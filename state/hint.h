// Hints (spec 5.6).
#pragma once

#include "state/gl_types.h"

namespace halfspace::state {

struct HintState {
  GLenum perspective_correction = GL_DONT_CARE;
  GLenum point_smooth = GL_DONT_CARE;
  GLenum line_smooth = GL_DONT_CARE;
  GLenum polygon_smooth = GL_DONT_CARE;
  GLenum fog = GL_DONT_CARE;
};

}  // namespace halfspace::state
