#include "raster/api/texture.h"

#include <algorithm>
#include <cstring>

#include "tests/oracle/contract/impl.h"

namespace halfspace::raster {

struct Texture::Impl {
  std::array<std::shared_ptr<const TextureLevel>, kMaxTextureLevels> levels;
};

namespace {

// First byte of the level's row `row`, counted with the border.
uint8_t* row_of(oracle::Level& level, int row) {
  return &level.rgba[4 * static_cast<size_t>(row) * static_cast<size_t>(level.width + 2 * level.border)];
}

}  // namespace

size_t TextureView::bytes() const {
  size_t sum = 0;
  for (int n = 0; n < level_count; ++n) sum += levels[static_cast<size_t>(n)]->level.rgba.size();
  return sum;
}

Texture::Texture() : impl_(std::make_unique<Impl>()) {}
Texture::~Texture() = default;

void Texture::define_level(int level, int width, int height, int border, BaseFormat base_format,
                           const uint8_t* rgba, size_t row_stride) {
  const RowSource rows = [&](int row) { return rgba + static_cast<size_t>(row) * row_stride; };
  define_level(level, width, height, border, base_format, rgba ? rows : nullptr);
}

void Texture::define_level(int level, int width, int height, int border, BaseFormat base_format,
                           const RowSource& rows) {
  if (width <= 0 || height <= 0) return remove_level(level);
  auto made = std::make_shared<TextureLevel>();
  made->base_format = base_format;
  oracle::Level& l = made->level;
  l.width = width, l.height = height, l.border = border;
  const size_t row_bytes = 4 * static_cast<size_t>(width + 2 * border);
  l.rgba.resize(row_bytes * static_cast<size_t>(height + 2 * border));
  for (int row = 0; rows && row < height + 2 * border; ++row)
    std::memcpy(row_of(l, row), rows(row), row_bytes);
  impl_->levels[static_cast<size_t>(level)] = std::move(made);
}

void Texture::update_level(int level, int x, int y, int w, int h, const uint8_t* rgba, size_t row_stride) {
  update_level(level, x, y, w, h, [&](int row) { return rgba + static_cast<size_t>(row) * row_stride; });
}

void Texture::update_level(int level, int x, int y, int w, int h, const RowSource& rows) {
  auto& slot = impl_->levels[static_cast<size_t>(level)];
  if (!slot || w <= 0 || h <= 0) return;
  auto made = std::make_shared<TextureLevel>(*slot);
  oracle::Level& l = made->level;
  for (int row = 0; row < h; ++row)
    std::memcpy(row_of(l, y + row + l.border) + 4 * (x + l.border), rows(row), 4 * static_cast<size_t>(w));
  slot = std::move(made);
}

void Texture::read_level(int level, uint8_t* rgba, size_t row_stride) const {
  const auto& slot = impl_->levels[static_cast<size_t>(level)];
  if (!slot) return;
  const oracle::Level& l = slot->level;
  const size_t row_bytes = 4 * static_cast<size_t>(l.width + 2 * l.border);
  for (int row = 0; row < l.height + 2 * l.border; ++row)
    std::memcpy(rgba + static_cast<size_t>(row) * row_stride, &l.rgba[static_cast<size_t>(row) * row_bytes],
                row_bytes);
}

void Texture::remove_level(int level) { impl_->levels[static_cast<size_t>(level)].reset(); }

Texture::LevelInfo Texture::level_info(int level) const {
  if (level < 0 || level >= kMaxTextureLevels) return {};
  const auto& slot = impl_->levels[static_cast<size_t>(level)];
  if (!slot) return {};
  return {slot->level.width, slot->level.height, slot->level.border, slot->base_format};
}

std::shared_ptr<const TextureView> Texture::view(const Sampler& sampler, int level_count) {
  auto made = std::make_shared<TextureView>();
  made->sampler = sampler;
  for (int n = 0; n < std::min(level_count, kMaxTextureLevels) && impl_->levels[static_cast<size_t>(n)]; ++n)
    made->levels[static_cast<size_t>(made->level_count++)] = impl_->levels[static_cast<size_t>(n)];
  if (made->level_count > 0) made->base_format = made->levels[0]->base_format;
  return made;
}

}  // namespace halfspace::raster
