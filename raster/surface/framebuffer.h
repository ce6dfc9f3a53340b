// How a framebuffer's pixels lie in memory.
//
// Tiles of 64x64 pixels, row by row from the bottom; a tile is 64 blocks of 8x8, row by row; a block is 64 pixels, row
// by row. So a block is 256 contiguous bytes of colour and 256 of depth, whatever the pitch of the picture.
// An rgba32f block is planar: 64 reds, 64 greens, 64 blues, 64 alphas.
#pragma once

#include <cstdint>
#include <vector>

#include "raster/api/framebuffer.h"
#include "raster/primitive/segment.h"
#include "raster/surface/page_buffer.h"

namespace halfspace::raster {

inline constexpr uint32_t kDepthMax = (1u << 24) - 1;
inline constexpr int kBlockPixels = kBlockSize * kBlockSize;
inline constexpr int kTilePixels = kTileSize * kTileSize;
inline constexpr int kTileBlocks = kTilePixels / kBlockPixels;

// A clear marks blocks; their memory is written when something is drawn on them. Bit b: block b.
struct TileState {
  uint64_t color_is_clear = 0, depth_is_clear = 0;
  uint32_t clear_rgba8 = 0;
  uint32_t clear_depth = 0;
  Color clear_color;                    // the same colour, for rgba32f
  uint32_t depth_max[kTileBlocks] = {};  // no pixel of the block lies deeper: 24-bit, coarse z
};

// A framebuffer's storage as the tile workers see it.
struct Framebuffer::Impl {
  Impl(int w, int h, ColorFormat f);

  int width, height, tiles_x, tiles_y;
  ColorFormat format;
  std::vector<TileState> tiles;

  size_t color_pixel_bytes() const { return format == ColorFormat::rgba8 ? 4 : 16; }
  // First pixel of a tile; an rgba32f pixel is four floats. need_color / need_depth must have been called.
  template <class T>
  T* color_tile(size_t tile) const {
    return reinterpret_cast<T*>(color_.as<std::byte>() + tile * kTilePixels * color_pixel_bytes());
  }
  uint32_t* depth_tile(size_t tile) const { return depth_.as<uint32_t>() + tile * kTilePixels; }
  // Storage comes to be at the first call.
  void need_color();
  void need_depth();

  // The tile's pixels inside the framebuffer, in window coordinates.
  Rect tile_rect(size_t tile) const;
  // Writes the clear value into the blocks of `mask` that still only hold it as a mark.
  void settle_color(size_t tile, uint64_t mask);
  void settle_depth(size_t tile, uint64_t mask);

 private:
  PageBuffer color_, depth_;
};

// Rounds to nearest; `c` is clamped to [0, 1], NaN is 0.
uint32_t pack_rgba8(const Color& c);

}  // namespace halfspace::raster
