#include "raster/surface/framebuffer.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "raster/surface/rows.h"

namespace halfspace::raster {
namespace {

int tiles_for(int pixels) { return (pixels + kTileSize - 1) / kTileSize; }

// Fills the blocks of `mask` that are marked, and takes their marks off. `fill(block)` writes one block.
template <class Fill>
void settle(uint64_t& marks, uint64_t mask, Fill fill) {
  for (uint64_t todo = marks & mask; todo != 0; todo &= todo - 1) fill(std::countr_zero(todo));
  marks &= ~mask;
}

// The same for blocks of words in `memory`. They are on their way from afar: few wide stores wait for them, where many
// narrow ones would not find room to wait.
void settle_words(uint64_t& marks, uint64_t mask, uint32_t value, uint32_t* memory) {
  const auto fill = row_functions().fill_row;
  settle(marks, mask, [&](int block) { fill(value, kBlockPixels, memory + block * kBlockPixels); });
}

}  // namespace

uint32_t pack_rgba8(const Color& c) {
  auto byte = [](float v) {
    const float clamped = v > 0 ? std::min(v, 1.0f) : 0.0f;
    return static_cast<uint32_t>(static_cast<double>(clamped) * 255.0 + 0.5);
  };
  return byte(c.r) | byte(c.g) << 8 | byte(c.b) << 16 | byte(c.a) << 24;
}

// All pixels are zero, and nothing is stored yet: the tiles start as cleared to zero.
Framebuffer::Impl::Impl(int w, int h, ColorFormat f, int plane_count)
    : width(w), height(h), tiles_x(tiles_for(w)), tiles_y(tiles_for(h)), planes(plane_count), format(f) {
  tiles.resize(static_cast<size_t>(tiles_x) * static_cast<size_t>(tiles_y));
}

void Framebuffer::Impl::need_color(uint8_t targets) {
  for (const ColorPlane plane : {kBackPlane, kFrontPlane}) {
    PageBuffer& pixels = color_[plane_index(plane)];
    if ((targets & plane) != 0 && !pixels) pixels = PageBuffer(tiles.size() * kTilePixels * color_pixel_bytes());
  }
}

void Framebuffer::Impl::need_depth() {
  if (!depth_) depth_ = PageBuffer(tiles.size() * kTilePixels * sizeof(uint32_t));
}

void Framebuffer::Impl::need_stencil() {
  if (!stencil_) stencil_ = PageBuffer(tiles.size() * kTilePixels);
}

void Framebuffer::Impl::need_accum() {
  if (!accum_) accum_ = PageBuffer(tiles.size() * kTilePixels * 4 * sizeof(int16_t));
}

Rect Framebuffer::Impl::tile_rect(size_t tile) const {
  const int x = static_cast<int>(tile % static_cast<size_t>(tiles_x)) * kTileSize;
  const int y = static_cast<int>(tile / static_cast<size_t>(tiles_x)) * kTileSize;
  return {x, y, std::min(x + kTileSize, width), std::min(y + kTileSize, height)};
}

void Framebuffer::Impl::settle_color(size_t tile, uint64_t mask, int plane) {
  ColorMarks& marks = tiles[tile].color[plane];
  if (format == ColorFormat::rgba8)
    return settle_words(marks.is_clear, mask, marks.rgba8, color_tile<uint32_t>(tile, plane));
  settle(marks.is_clear, mask, [&](int block) {
    std::byte* pixels = color_tile<std::byte>(tile, plane) + static_cast<size_t>(block) * kBlockPixels * color_pixel_bytes();
    float* channels = reinterpret_cast<float*>(pixels);
    const float value[4] = {marks.value.r, marks.value.g, marks.value.b, marks.value.a};
    for (int c = 0; c < 4; ++c) std::fill_n(channels + c * kBlockPixels, kBlockPixels, value[c]);
  });
}

void Framebuffer::Impl::settle_depth(size_t tile, uint64_t mask) {
  TileState& state = tiles[tile];
  settle_words(state.depth_is_clear, mask, state.clear_depth, depth_tile(tile));
  if ((state.depth_on_plane & mask) == 0) return;
  row_functions().fill_depth(state.depth_plane, state.depth_on_plane & mask, depth_tile(tile));
  state.depth_on_plane &= ~mask;
}

void Framebuffer::Impl::settle_stencil(size_t tile, uint64_t mask) {
  TileState& state = tiles[tile];
  settle(state.stencil_is_clear, mask, [&](int block) {
    std::fill_n(stencil_tile(tile) + block * kBlockPixels, kBlockPixels, state.clear_stencil);
  });
}

void Framebuffer::Impl::settle_accum(size_t tile, uint64_t mask) {
  TileState& state = tiles[tile];
  settle(state.accum_is_clear, mask, [&](int block) {
    int16_t* out = accum_tile(tile) + block * kBlockPixels * 4;
    for (int i = 0; i < kBlockPixels; ++i) std::copy_n(state.clear_accum, 4, out + i * 4);
  });
}

Framebuffer::Framebuffer(int width, int height, ColorFormat format, int planes) {
  if (width < 1 || height < 1 || width > kMaxSurfaceSize || height > kMaxSurfaceSize)
    throw std::invalid_argument("framebuffer: width and height must be 1 to 16384");
  if (planes < 1 || planes > kMaxColorPlanes) throw std::invalid_argument("framebuffer: 1 or 2 colour planes");
  impl_ = std::make_unique<Impl>(width, height, format, planes);
}
Framebuffer::~Framebuffer() = default;
int Framebuffer::width() const { return impl_->width; }
int Framebuffer::height() const { return impl_->height; }
ColorFormat Framebuffer::format() const { return impl_->format; }
int Framebuffer::planes() const { return impl_->planes; }

}  // namespace halfspace::raster
