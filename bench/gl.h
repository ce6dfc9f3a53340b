// OpenGL of the library that is being measured: gl.Begin(GL_TRIANGLES) and so on.
#pragma once

#include <GL/gl.h>

namespace halfspace::bench {

struct Gl {
#define GL_FUNCTION(name) decltype(&::gl##name) name = nullptr;
#include "bench/gl_functions.def"
#undef GL_FUNCTION
};

// Filled by Library. A process measures one library.
extern Gl gl;

}  // namespace halfspace::bench
