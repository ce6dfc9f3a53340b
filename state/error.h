// The error flag (spec 2.5).
#pragma once

#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

struct ErrorState {
  GLenum code = GL_NO_ERROR;
};

// Records `code`; the first error stands until glGetError takes it. `operation` names the caller for the line
// that HALFSPACE_DEBUG=1 prints; the default is the function the call stands in.
void record_error(Context& context, GLenum code, const char* operation = __builtin_FUNCTION());

}  // namespace halfspace::state
