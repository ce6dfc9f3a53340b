// Alpha test, blending, logical operation, colour mask, clear colour, and which buffers are drawn to and read
// (spec 4.1.4, 4.1.7, 4.1.9, 4.2).
#pragma once

#include "raster/api/device.h"
#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

struct ColorBufferState {
  bool alpha_test = false;
  GLenum alpha_func = GL_ALWAYS;
  float alpha_reference = 0;  // in [0, 1]
  bool blend = false;
  GLenum blend_src = GL_ONE, blend_dst = GL_ZERO;
  bool color_logic_op = false, index_logic_op = false;
  GLenum logic_op = GL_COPY;
  bool dither = true;  // 8-bit buffers show every colour as it is: never any effect
  raster::ColorMask mask;
  raster::Color clear_color;  // in [0, 1]
  float clear_index = 0;
  GLuint index_mask = ~GLuint{0};  // of colour-index visuals; kept and queried
  GLenum draw_buffer = GL_NONE, read_buffer = GL_NONE;
};

// The colour planes that drawing goes to, as bits of raster::ColorPlane; 0 for GL_NONE, when only depth and
// stencil are drawn.
uint8_t draw_planes(const Context& context);
// The plane that glReadPixels, glCopyPixels and their like read.
raster::ColorPlane read_plane(const Context& context);

// Drawing goes to draw_planes() of this, reading is from read_plane() of this. Primitives that wait are drawn
// first. Null when there is no drawable.
raster::Framebuffer* draw_framebuffer(Context& context);
raster::Framebuffer* read_framebuffer(Context& context);

}  // namespace halfspace::state
