#include "raster/surface/framebuffer.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace halfspace::raster {
namespace {

int tiles_for(int pixels) { return (pixels + kTileSize - 1) / kTileSize; }

}  // namespace

uint32_t pack_rgba8(const Color& c) {
  auto byte = [](float v) {
    const float clamped = v > 0 ? std::min(v, 1.0f) : 0.0f;
    return static_cast<uint32_t>(static_cast<double>(clamped) * 255.0 + 0.5);
  };
  return byte(c.r) | byte(c.g) << 8 | byte(c.b) << 16 | byte(c.a) << 24;
}

Framebuffer::Impl::Impl(int w, int h, ColorFormat f)
    : width(w), height(h), tiles_x(tiles_for(w)), tiles_y(tiles_for(h)), format(f) {
  tiles.resize(static_cast<size_t>(tiles_x) * static_cast<size_t>(tiles_y));
  // All pixels are zero, and nothing is stored yet: the same as cleared to zero.
  for (TileState& tile : tiles) tile.color_is_clear = tile.depth_is_clear = ~uint64_t{0};
}

void Framebuffer::Impl::need_color() {
  if (!color_) color_ = PageBuffer(tiles.size() * kTilePixels * color_pixel_bytes());
}

void Framebuffer::Impl::need_depth() {
  if (!depth_) depth_ = PageBuffer(tiles.size() * kTilePixels * sizeof(uint32_t));
}

Rect Framebuffer::Impl::tile_rect(size_t tile) const {
  const int x = static_cast<int>(tile % static_cast<size_t>(tiles_x)) * kTileSize;
  const int y = static_cast<int>(tile / static_cast<size_t>(tiles_x)) * kTileSize;
  return {x, y, std::min(x + kTileSize, width), std::min(y + kTileSize, height)};
}

void Framebuffer::Impl::settle_color(size_t tile, uint64_t mask) {
  TileState& state = tiles[tile];
  for (uint64_t todo = state.color_is_clear & mask; todo != 0; todo &= todo - 1) {
    const int block = std::countr_zero(todo);
    std::byte* pixels = color_tile<std::byte>(tile) + static_cast<size_t>(block) * kBlockPixels * color_pixel_bytes();
    if (format == ColorFormat::rgba8) {
      std::fill_n(reinterpret_cast<uint32_t*>(pixels), kBlockPixels, state.clear_rgba8);
    } else {
      float* planes = reinterpret_cast<float*>(pixels);
      const float value[4] = {state.clear_color.r, state.clear_color.g, state.clear_color.b, state.clear_color.a};
      for (int c = 0; c < 4; ++c) std::fill_n(planes + c * kBlockPixels, kBlockPixels, value[c]);
    }
  }
  state.color_is_clear &= ~mask;
}

void Framebuffer::Impl::settle_depth(size_t tile, uint64_t mask) {
  TileState& state = tiles[tile];
  for (uint64_t todo = state.depth_is_clear & mask; todo != 0; todo &= todo - 1) {
    const int block = std::countr_zero(todo);
    std::fill_n(depth_tile(tile) + block * kBlockPixels, kBlockPixels, state.clear_depth);
  }
  state.depth_is_clear &= ~mask;
}

Framebuffer::Framebuffer(int width, int height, ColorFormat format, int) {
  if (width < 1 || height < 1 || width > kMaxSurfaceSize || height > kMaxSurfaceSize)
    throw std::invalid_argument("framebuffer: width and height must be 1 to 16384");
  impl_ = std::make_unique<Impl>(width, height, format);
}
Framebuffer::~Framebuffer() = default;
int Framebuffer::width() const { return impl_->width; }
int Framebuffer::height() const { return impl_->height; }
ColorFormat Framebuffer::format() const { return impl_->format; }

}  // namespace halfspace::raster
