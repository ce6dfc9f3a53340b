// Alpha test, blending, colour mask, clear colour, and which buffers are drawn to and read
// (spec 4.1.4, 4.1.7, 4.2).
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
  bool dither = true;  // 8-bit buffers show every colour as it is: never any effect
  raster::ColorMask mask;
  raster::Color clear_color;  // in [0, 1]
  float clear_index = 0;
  GLuint index_mask = ~GLuint{0};  // of colour-index visuals; kept and queried
  GLenum draw_buffer = GL_NONE, read_buffer = GL_NONE;
};

// The buffer glReadPixels reads, or null when there is no drawable.
raster::Framebuffer* read_framebuffer(Context& context);

// The buffers drawing goes to, at most two (GL_FRONT_AND_BACK of a double-buffered drawable); returns how
// many. Zero: GL_NONE, or no drawable.
int draw_framebuffers(Context& context, raster::Framebuffer* out[2]);

// For each buffer that drawing goes to: begins the device's pass on it and calls draw(device).
template <class Draw>
void draw_to_buffers(Context& context, raster::Device& device, Draw&& draw) {
  raster::Framebuffer* targets[2];
  const int count = draw_framebuffers(context, targets);
  for (int i = 0; i < count; ++i) {
    device.begin_pass(targets[i]);
    draw(device);
  }
}

}  // namespace halfspace::state
