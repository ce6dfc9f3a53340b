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

// Where a pixel of a tile lies in its memory.
inline int tile_offset(int x, int y) {
  return (y & 56) * kBlockPixels + (x & 56) * kBlockSize + (y & 7) * kBlockSize + (x & 7);
}

inline constexpr int kMaxColorPlanes = 2;
// Where a ColorPlane lies among a framebuffer's planes.
inline int plane_index(ColorPlane plane) { return plane == kFrontPlane ? 1 : 0; }

// A clear marks blocks; their memory is written when something is drawn on them. Bit b: block b.
struct ColorMarks {
  uint64_t is_clear = ~uint64_t{0};
  uint32_t rgba8 = 0;
  Color value;  // the same colour, for rgba32f
};
// The depth of a triangle that covers whole blocks and is nearer than all there was: nobody may look at it before the
// next such triangle comes. As SetupBatch has it; (dx, dy): the centre of the tile's first pixel less the anchor.
struct DepthPlane {
  double f0 = 0, dfdx = 0, dfdy = 0, dx = 0, dy = 0;
  // Of a row's pixel, what the depth test makes of it.
  double row(int y) const { return f0 + dfdy * (dy + y); }
  double across(int x) const { return dfdx * (dx + x); }
  static uint32_t depth(double row, double across) {
    const double sum = row + across;
    return static_cast<uint32_t>(static_cast<int32_t>(sum > 0 ? sum : 0));
  }
};

// Whether it pays in a tile to try something: for one of kLeast at least. Where it did not at the last visit, some visits
// pass until it is tried again. The picture does not depend on it.
template <uint64_t kLeast>
struct TrialHistory {
  static constexpr uint8_t kPause = 15;  // visits
  uint8_t pause = 0;
  // After a visit: how many it was tried for, and for how many it paid.
  void note(uint64_t tried, uint64_t paid) {
    if (pause > 0)
      --pause;
    else if (paid * kLeast < tried)
      pause = kPause;
  }
};

struct TileState {
  ColorMarks color[kMaxColorPlanes];
  uint64_t depth_is_clear = ~uint64_t{0};
  uint64_t depth_on_plane = 0;  // blocks that hold depth_plane's depth; never those that are clear
  // Blocks whose depth is not in memory.
  uint64_t depth_marks() const { return depth_is_clear | depth_on_plane; }
  uint32_t clear_depth = 0;
  DepthPlane depth_plane;
  uint8_t clear_stencil = 0;
  uint64_t stencil_is_clear = ~uint64_t{0}, accum_is_clear = ~uint64_t{0};
  int16_t clear_accum[4] = {};
  uint32_t depth_max[kTileBlocks] = {};  // no pixel of the block lies deeper: 24-bit, coarse z
  uint32_t depth_min[kTileBlocks] = {};  // nor nearer than this, where depth_min_holds
  uint64_t depth_min_holds = 0;
  TrialHistory<8> deferrals;  // pixels whose colours wait, and those that then need not be shaded
  TrialHistory<6> hidden;     // triangles, and those behind others (with one of 16 tri_100px takes 1.03)
};

// A framebuffer's storage as the tile workers see it.
struct Framebuffer::Impl {
  Impl(int w, int h, ColorFormat f, int plane_count);

  int width, height, tiles_x, tiles_y;
  int planes;
  ColorFormat format;
  std::vector<TileState> tiles;

  size_t color_pixel_bytes() const { return format == ColorFormat::rgba8 ? 4 : 16; }
  // First pixel of a tile; an rgba32f pixel is four floats. The plane must have been asked for with need_*.
  template <class T>
  T* color_tile(size_t tile, int plane) const {
    return reinterpret_cast<T*>(color_[plane].as<std::byte>() + tile * kTilePixels * color_pixel_bytes());
  }
  uint32_t* depth_tile(size_t tile) const { return depth_.as<uint32_t>() + tile * kTilePixels; }
  uint8_t* stencil_tile(size_t tile) const { return stencil_.as<uint8_t>() + tile * kTilePixels; }
  // Four numbers a pixel, r g b a; 32767 is 1.0.
  int16_t* accum_tile(size_t tile) const { return accum_.as<int16_t>() + tile * kTilePixels * 4; }
  bool has_color(uint8_t targets) const {
    return ((targets & kBackPlane) == 0 || color_[0]) && ((targets & kFrontPlane) == 0 || color_[1]);
  }
  bool has_depth() const { return bool(depth_); }
  bool has_stencil() const { return bool(stencil_); }
  // Storage comes to be at the first call. `targets`: bits of ColorPlane.
  void need_color(uint8_t targets);
  void need_depth();
  void need_stencil();
  void need_accum();
  // Those of `targets` that there are: a framebuffer of one plane has the back plane only.
  uint8_t existing(uint8_t targets) const {
    return static_cast<uint8_t>(targets & (planes == 2 ? kBackPlane | kFrontPlane : kBackPlane));
  }

  // The tile's pixels inside the framebuffer, in window coordinates.
  Rect tile_rect(size_t tile) const;
  // Writes the value into the blocks of `mask` that still only hold it as a mark.
  void settle_color(size_t tile, uint64_t mask, int plane);
  void settle_depth(size_t tile, uint64_t mask);
  void settle_stencil(size_t tile, uint64_t mask);
  void settle_accum(size_t tile, uint64_t mask);

 private:
  PageBuffer color_[kMaxColorPlanes], depth_, stencil_, accum_;
};

// Rounds to nearest; `c` is clamped to [0, 1], NaN is 0.
uint32_t pack_rgba8(const Color& c);

// The bytes of an rgba8 pixel that the mask lets through.
inline uint32_t byte_mask(const ColorMask& mask) {
  return (mask.r ? 0xffu : 0u) | (mask.g ? 0xff00u : 0u) | (mask.b ? 0xff0000u : 0u) | (mask.a ? 0xff000000u : 0u);
}

}  // namespace halfspace::raster
