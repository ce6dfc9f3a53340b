#include "raster/api/texture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

#include "raster/isa.h"
#include "raster/texture/level.h"

namespace halfspace::raster {
namespace {

constexpr uint32_t kAlphaMask = 0xff000000u;

uint32_t load_texel(const uint8_t* p) {
  return uint32_t(p[0]) | uint32_t(p[1]) << 8 | uint32_t(p[2]) << 16 | uint32_t(p[3]) << 24;
}

void store_texel(uint8_t* p, uint32_t texel) {
  for (int c = 0; c < 4; ++c) p[c] = uint8_t(texel >> (8 * c));
}

uint32_t unorm8(float v) {
  if (!(v > 0)) return 0;  // NaN too
  if (v >= 1) return 255;
  return uint32_t(v * 255.0f + 0.5f);
}

// Spec 3.8.1: the border colour is taken as RGBA and reduced to the components of the internal format (table
// 3.15), then seen as table 3.21 expands them.
uint32_t border_texel_of(const Color& color, BaseFormat format) {
  const uint32_t r = unorm8(color.r), g = unorm8(color.g), b = unorm8(color.b), a = unorm8(color.a);
  const auto pack = [](uint32_t pr, uint32_t pg, uint32_t pb, uint32_t pa) {
    return pr | pg << 8 | pb << 16 | pa << 24;
  };
  switch (format) {
    case BaseFormat::alpha:
      return pack(0, 0, 0, a);
    case BaseFormat::luminance:
      return pack(r, r, r, 255);
    case BaseFormat::luminance_alpha:
      return pack(r, r, r, a);
    case BaseFormat::intensity:
      return pack(r, r, r, r);
    case BaseFormat::rgb:
      return pack(r, g, b, 255);
    case BaseFormat::rgba:
      break;
  }
  return pack(r, g, b, a);
}

size_t storage_texels(int width, int height) { return size_t(width + 2) * size_t(height + 2) + 1; }

using TexelArray = std::unique_ptr<uint32_t[], AlignedDelete>;
TexelArray allocate_texels(size_t count) {
  return TexelArray(static_cast<uint32_t*>(::operator new[](count * sizeof(uint32_t), std::align_val_t{64})));
}

// Without their texels.
std::shared_ptr<TextureLevel> shape_level(int width, int height, int border, BaseFormat format) {
  auto level = std::make_shared<TextureLevel>();
  level->width = width;
  level->height = height;
  level->pitch = width + 2;
  level->border = border;
  level->base_format = format;
  if (border) level->border_texels.resize(size_t(width + 2) * 2 + size_t(height) * 2);
  return level;
}

std::shared_ptr<TextureLevel> allocate_level(int width, int height, int border, BaseFormat format) {
  auto level = shape_level(width, height, border, format);
  const size_t count = storage_texels(width, height);
  level->storage = allocate_texels(count);
  level->base = level->texels = level->storage.get();
  level->texels[count - 1] = 0;  // the padding: loaded, never weighed in
  return level;
}

// All texels zero. From a few megabytes on, pages that nobody writes are never made: a program that asks for the
// largest texture there is and fills a corner of it gets it at once.
std::shared_ptr<TextureLevel> allocate_zeros(int width, int height, int border, BaseFormat format) {
  constexpr size_t kLarge = size_t{4} << 20;
  const size_t bytes = storage_texels(width, height) * sizeof(uint32_t);
  if (bytes < kLarge) {
    auto level = allocate_level(width, height, border, format);
    std::memset(level->texels, 0, bytes);
    return level;
  }
  auto level = shape_level(width, height, border, format);
  level->pages = PageBuffer(bytes);
  level->base = level->texels = level->pages.as<uint32_t>();
  return level;
}

std::shared_ptr<TextureLevel> clone_level(const TextureLevel& from) {
  auto level = allocate_level(from.width, from.height, from.border, from.base_format);
  std::memcpy(level->texels, from.base, storage_texels(from.width, from.height) * sizeof(uint32_t));
  level->border_texels = from.border_texels;
  level->opaque = from.opaque;
  level->image_opaque = from.image_opaque;
  level->skirt = from.skirt;
  level->skirt_valid = from.skirt_valid;
  return level;
}

uint32_t* texel_address(TextureLevel& level, int i, int j) {
  return level.texels + ptrdiff_t(j + 1) * level.pitch + (i + 1);
}

bool is_inside(const TextureLevel& level, int i, int j) {
  return i >= 0 && i < level.width && j >= 0 && j < level.height;
}

// Index of border texel (i, j), which lies outside the image, in border_texels.
size_t border_index(const TextureLevel& level, int i, int j) {
  const size_t row = size_t(level.width) + 2;
  if (j < 0) return size_t(i + 1);
  if (j >= level.height) return row + size_t(i + 1);
  return 2 * row + (i < 0 ? 0 : size_t(level.height)) + size_t(j);
}

// Copies a row of packed bytes over texels [x, x + w) of row y, border texels included.
void write_row(TextureLevel& level, int x, int y, int w, const uint8_t* row) {
  uint32_t alpha = kAlphaMask;
  for (int k = 0; k < w;) {
    const int i = x + k;
    if (!is_inside(level, i, y)) {
      level.border_texels[border_index(level, i, y)] = load_texel(row + size_t(k) * 4);
      ++k;
      continue;
    }
    const int run = std::min(w - k, level.width - i);
    uint32_t* out = texel_address(level, i, y);
    for (int n = 0; n < run; ++n) {
      out[n] = load_texel(row + size_t(k + n) * 4);
      alpha &= out[n];
    }
    k += run;
  }
  level.image_opaque = level.image_opaque && alpha == kAlphaMask;
}

// Where index i of an axis of `size` texels looks, for i in [-1, size].
int wrapped(int i, int size, Wrap wrap) {
  if (i >= 0 && i < size) return i;
  switch (wrap) {
    case Wrap::repeat:
      return i < 0 ? size - 1 : 0;
    case Wrap::clamp_to_edge:
      return i < 0 ? 0 : size - 1;
    case Wrap::clamp:
      break;
  }
  return i;
}

SkirtKey skirt_key(const TextureLevel& level, const Sampler& sampler) {
  SkirtKey key{sampler.wrap_s, sampler.wrap_t, 0};
  const bool clamps = key.wrap_s == Wrap::clamp || key.wrap_t == Wrap::clamp;
  if (clamps && level.border == 0)
    key.border_texel = border_texel_of(sampler.border_color, level.base_format);
  return key;
}

uint32_t skirt_texel(const TextureLevel& level, int i, int j, const SkirtKey& key) {
  const int si = wrapped(i, level.width, key.wrap_s);
  const int sj = wrapped(j, level.height, key.wrap_t);
  if (is_inside(level, si, sj)) return level.texel(si, sj);
  return level.border ? level.border_texels[border_index(level, si, sj)] : key.border_texel;
}

void fill_skirt(TextureLevel& level, const SkirtKey& key) {
  uint32_t alpha = kAlphaMask;
  const auto fill = [&](int i, int j) {
    const uint32_t texel = skirt_texel(level, i, j, key);
    *texel_address(level, i, j) = texel;
    alpha &= texel;
  };
  for (int i = -1; i <= level.width; ++i) {
    fill(i, -1);
    fill(i, level.height);
  }
  for (int j = 0; j < level.height; ++j) {
    fill(-1, j);
    fill(level.width, j);
  }
  level.opaque = level.image_opaque && alpha == kAlphaMask;
  level.skirt = key;
  level.skirt_valid = true;
}

// What a second-level cache holds beside what else is drawn with.
constexpr size_t kMostStacked = size_t{256} * 256;

size_t stacked_texels(const TextureLevel& level) { return 2 * size_t(level.pitch) * size_t(level.height + 1); }

// Where kernels load from what is stacked.
bool wants_stacked(const TextureLevel& level, const Sampler& sampler) {
  const bool linear = sampler.mag == Filter::linear || sampler.min == Filter::linear;
  return linear && current_isa() == Isa::avx512 && size_t(level.width) * size_t(level.height) <= kMostStacked;
}

void stack_rows(TextureLevel& level) {
  const size_t count = stacked_texels(level);
  if (!level.stacked) level.stacked = allocate_texels(count);
  const uint32_t* from = level.base;
  for (uint32_t* out = level.stacked.get(); out != level.stacked.get() + count; out += 2, ++from) {
    out[0] = from[0];
    out[1] = from[level.pitch];
  }
}

}  // namespace

size_t TextureView::bytes() const {
  size_t sum = 0;
  for (int n = 0; n < level_count; ++n) {
    const TextureLevel& level = *levels[size_t(n)];
    sum += storage_texels(level.width, level.height) * sizeof(uint32_t);
    if (level.stacked) sum += stacked_texels(level) * sizeof(uint32_t);
  }
  return sum;
}

struct Texture::Impl {
  std::array<std::shared_ptr<TextureLevel>, kMaxTextureLevels> levels;
  std::shared_ptr<const TextureView> cached_view;

  // True when no view outside holds `level`; call after the cached view is dropped. use_count() orders nothing:
  // taking one more reference and giving it up acquires what the thread that gave up its view released. (A fence
  // would do as well, but the thread sanitizer does not know fences.)
  static bool is_sole(const std::shared_ptr<TextureLevel>& level) {
    if (level.use_count() != 1) return false;
    std::shared_ptr<TextureLevel>(level).reset();
    return true;
  }

  TextureLevel* find(int level) const {
    return level >= 0 && level < kMaxTextureLevels ? levels[size_t(level)].get() : nullptr;
  }
};

Texture::Texture() : impl_(std::make_unique<Impl>()) {}
Texture::~Texture() = default;

void Texture::define_level(int level, int width, int height, int border, BaseFormat base_format,
                           const uint8_t* rgba, size_t row_stride) {
  const RowSource rows = [&](int row) { return rgba + size_t(row) * row_stride; };
  define_level(level, width, height, border, base_format, rgba ? rows : nullptr);
}

void Texture::define_level(int level, int width, int height, int border, BaseFormat base_format,
                           const RowSource& rows) {
  assert(level >= 0 && level < kMaxTextureLevels);
  if (width <= 0 || height <= 0) return remove_level(level);
  std::shared_ptr<TextureLevel>& slot = impl_->levels[size_t(level)];
  impl_->cached_view.reset();
  if (!rows) {
    slot = allocate_zeros(width, height, border, base_format);
    return;
  }
  const bool reuse =
      slot && Impl::is_sole(slot) && slot->width == width && slot->height == height && slot->border == border;
  std::shared_ptr<TextureLevel> fresh = reuse ? slot : allocate_level(width, height, border, base_format);
  fresh->base_format = base_format;
  fresh->skirt_valid = false;
  fresh->image_opaque = true;
  for (int y = -border; y < height + border; ++y) {
    write_row(*fresh, -border, y, width + 2 * border, rows(y + border));
  }
  slot = std::move(fresh);
}

void Texture::update_level(int level, int x, int y, int w, int h, const uint8_t* rgba, size_t row_stride) {
  update_level(level, x, y, w, h, [&](int row) { return rgba + size_t(row) * row_stride; });
}

void Texture::update_level(int level, int x, int y, int w, int h, const RowSource& rows) {
  TextureLevel* old = impl_->find(level);
  if (!old || w <= 0 || h <= 0) return;
  assert(x >= -old->border && x + w <= old->width + old->border);
  assert(y >= -old->border && y + h <= old->height + old->border);
  std::shared_ptr<TextureLevel>& slot = impl_->levels[size_t(level)];
  impl_->cached_view.reset();
  if (!Impl::is_sole(slot)) slot = clone_level(*old);
  slot->skirt_valid = false;
  const bool whole = x <= 0 && y <= 0 && x + w >= slot->width && y + h >= slot->height;
  slot->image_opaque = slot->image_opaque || whole;  // write_row takes it back
  for (int row = 0; row < h; ++row) write_row(*slot, x, y + row, w, rows(row));
}

void Texture::read_level(int level, uint8_t* rgba, size_t row_stride) const {
  const TextureLevel* from = impl_->find(level);
  if (!from) return;
  const int b = from->border;
  for (int j = -b; j < from->height + b; ++j) {
    uint8_t* row = rgba + size_t(j + b) * row_stride;
    for (int i = -b; i < from->width + b; ++i) {
      const uint32_t texel =
          is_inside(*from, i, j) ? from->texel(i, j) : from->border_texels[border_index(*from, i, j)];
      store_texel(row + size_t(i + b) * 4, texel);
    }
  }
}

void Texture::remove_level(int level) {
  assert(level >= 0 && level < kMaxTextureLevels);
  impl_->cached_view.reset();
  impl_->levels[size_t(level)].reset();
}

Texture::LevelInfo Texture::level_info(int level) const {
  const TextureLevel* found = impl_->find(level);
  if (!found) return {};
  return {found->width, found->height, found->border, found->base_format};
}

std::shared_ptr<const TextureView> Texture::view(const Sampler& sampler, int level_count) {
  if (impl_->cached_view && impl_->cached_view->level_count == level_count &&
      impl_->cached_view->sampler == sampler) {
    return impl_->cached_view;
  }
  impl_->cached_view.reset();
  auto view = std::make_shared<TextureView>();
  view->level_count = std::clamp(level_count, 0, kMaxTextureLevels);
  view->sampler = sampler;
  for (int n = 0; n < view->level_count; ++n) {
    std::shared_ptr<TextureLevel>& level = impl_->levels[size_t(n)];
    if (!level) {
      view->level_count = n;
      break;
    }
    const SkirtKey key = skirt_key(*level, sampler);
    const bool fills = !level->skirt_valid || !(level->skirt == key);
    // All levels are stacked if the first one is: kernels ask once for both levels of a lookup.
    const bool wants = n == 0 ? wants_stacked(*level, sampler) : view->levels[0]->stacked != nullptr;
    const bool stacks = level->stacked ? fills : wants;
    if ((fills || stacks) && !Impl::is_sole(level)) level = clone_level(*level);
    if (fills) fill_skirt(*level, key);
    if (stacks) stack_rows(*level);
    view->levels[size_t(n)] = level;
  }
  if (view->level_count > 0) view->base_format = view->levels[0]->base_format;
  impl_->cached_view = view;
  return view;
}

}  // namespace halfspace::raster
