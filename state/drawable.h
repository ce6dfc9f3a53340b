// What a context draws on. Front ends (GLX, OSMesa) implement it; the state room only asks.
#pragma once

#include "raster/api/device.h"

namespace halfspace::state {

// What the visual promised; glGet of GL_RED_BITS, GL_DOUBLEBUFFER and so on reads it.
struct VisualConfig {
  int red_bits = 8, green_bits = 8, blue_bits = 8, alpha_bits = 8;
  int depth_bits = 24, stencil_bits = 0, accum_bits = 0;
  bool double_buffered = false;
};

class Drawable {
 public:
  virtual ~Drawable() = default;
  virtual const VisualConfig& visual() const = 0;
  // Size in pixels, as of the last make-current or swap.
  virtual int width() const = 0;
  virtual int height() const = 0;
  // The buffers: one framebuffer, with a colour plane each. A single-buffered drawable's only plane is
  // kBackPlane. `planes`: bits of raster::ColorPlane, those about to be drawn to or read. Created when first
  // asked for; may throw std::bad_alloc.
  virtual raster::Framebuffer& framebuffer(uint8_t planes) = 0;
  // glFlush and glFinish: all drawing is executed; a picture that someone can see without a swap (OSMesa's user
  // buffer, a single-buffered window, a front buffer drawn to) is brought up to date. The device's current pass is
  // on the framebuffer; `planes`: what is drawn to.
  virtual void finish(raster::Device& device, uint8_t planes) = 0;
};

}  // namespace halfspace::state
