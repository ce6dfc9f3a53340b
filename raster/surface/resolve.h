// Tiled pixels to plain rows, in whatever order someone wants to see them.
#pragma once

#include "raster/surface/framebuffer.h"

namespace halfspace::raster {

// Converts the part of `tile` that both the framebuffer and the image have.
void resolve_tile(const Framebuffer::Impl& framebuffer, uint32_t tile, const LinearImage& image);

// Rows of the framebuffer: pixels [x0, x1) of row y, inside the framebuffer. Blocks that are only marked as cleared
// read as their clear value.
void read_row_rgba8(const Framebuffer::Impl& framebuffer, int x0, int x1, int y, uint32_t* out);
void read_row_float(const Framebuffer::Impl& framebuffer, int x0, int x1, int y, float* out);
void read_row_depth(const Framebuffer::Impl& framebuffer, int x0, int x1, int y, uint32_t* out);

}  // namespace halfspace::raster
