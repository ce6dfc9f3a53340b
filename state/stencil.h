// Stencil test and the stencil buffer's clear value and mask (spec 4.1.5, 4.2.2, 4.2.3).
#pragma once

#include "raster/api/stencil.h"
#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

struct StencilBufferState {
  bool test = false;
  GLenum func = GL_ALWAYS;
  GLint reference = 0;  // as given; used clamped to what the buffer holds
  GLuint value_mask = ~GLuint{0};
  GLenum fail = GL_KEEP, depth_fail = GL_KEEP, depth_pass = GL_KEEP;
  GLuint write_mask = ~GLuint{0};
  GLint clear_value = 0;
};

// What a draw of the context does. Without a stencil buffer the test always passes (spec 4.1.5).
raster::StencilState derive_stencil(const Context& context);

}  // namespace halfspace::state
