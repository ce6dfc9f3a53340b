// Tiled pixels to plain rows, in whatever order someone wants to see them.
#pragma once

#include "raster/surface/framebuffer.h"

namespace halfspace::raster {

// Converts the part of `count` neighbouring tiles of one row of tiles, from `first` on, that both the framebuffer and the
// image have. (left, bottom): the framebuffer's pixel that is the image's lowest-left one. `plane`: an index, as of all
// planes here.
void resolve_tiles(const Framebuffer::Impl& framebuffer, uint32_t first, uint32_t count, int plane,
                   const LinearImage& image, int left = 0, int bottom = 0);

// Rows of the framebuffer: pixels [x0, x1) of row y, inside the framebuffer. Blocks that are only marked as cleared
// read as their clear value.
void read_row_rgba8(const Framebuffer::Impl& framebuffer, int plane, int x0, int x1, int y, uint32_t* out);
void read_row_float(const Framebuffer::Impl& framebuffer, int plane, int x0, int x1, int y, float* out);
void read_row_depth(const Framebuffer::Impl& framebuffer, int x0, int x1, int y, uint32_t* out);
void read_row_stencil(const Framebuffer::Impl& framebuffer, int x0, int x1, int y, uint8_t* out);

// The part of `rect` that lies in the tile, from one plane to another. Both must have been asked for.
void copy_plane_tile(Framebuffer::Impl& framebuffer, uint32_t tile, int from, int to, const Rect& rect);

}  // namespace halfspace::raster
