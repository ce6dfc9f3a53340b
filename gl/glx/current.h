// Which context and drawables are current to the calling thread.
#pragma once

#include "gl/glx/registry.h"

namespace halfspace::gl::glx {

// Null when none is.
GlxContext* current_context();

// glXMakeContextCurrent. False, with everything as it was, when an argument is not valid, the context is
// current to another thread, or it does not go with a drawable.
bool make_current(Display* display, GLXDrawable draw, GLXDrawable read, GLXContext context);

// glXSwapBuffers and glXCopySubBufferMESA (with `part`, in GL's window coordinates).
void swap_buffers(Display* display, GLXDrawable drawable, const raster::Rect* part = nullptr);

// glXDestroyContext: at once, or when it is released.
void destroy_context(GLXContext context);

}  // namespace halfspace::gl::glx
