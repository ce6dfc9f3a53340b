// Pixels to draw on. Storage is by tile, and exists only where something was drawn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "raster/api/types.h"

namespace halfspace::raster {

// Order and width of a pixel in memory, lowest address first; rgb565 is a native-endian 16-bit word with red in
// the highest bits. With float_components each component is a float instead of a byte.
enum class PixelLayout : uint8_t { rgba, bgra, argb, rgb, bgr, rgb565, bgrx };

// A plain image to resolve to: where a window system or OSMesa's user wants to see the picture.
struct LinearImage {
  void* data = nullptr;       // first byte of the row that is lowest in memory
  ptrdiff_t row_bytes = 0;
  int width = 0, height = 0;  // pixels; what lies beyond the framebuffer is left alone
  PixelLayout layout = PixelLayout::rgba;
  bool float_components = false;
  bool y_up = true;           // row 0 is the bottom of the window
  bool opaque = false;        // the visual has no alpha: store 1 there
};

// Colour, 24-bit depth, 8-bit stencil and a 16-bit accumulation buffer, width x height (1..kMaxSurfaceSize). Contents
// start undefined (zero). `planes`: 1, or 2 for a back and a front colour plane over the same depth and stencil.
class Framebuffer {
 public:
  Framebuffer(int width, int height, ColorFormat format, int planes = 1);
  ~Framebuffer();
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  int width() const;
  int height() const;
  ColorFormat format() const;
  int planes() const;

  struct Impl;
  Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace halfspace::raster
