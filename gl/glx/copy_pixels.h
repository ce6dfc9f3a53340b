// Pixels back into a framebuffer.
#pragma once

#include <cstdint>

#include "raster/api/framebuffer.h"

namespace halfspace::gl::glx {

// Overwrites a colour plane of `target` (rgba8) with as many pixels of R, G, B, A bytes, the lowest row first.
// No device may have work pending on that plane.
void copy_pixels(raster::Framebuffer& target, raster::ColorPlane plane, const uint8_t* rgba);

}  // namespace halfspace::gl::glx
