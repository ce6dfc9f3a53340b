// Textures: storage of levels, and the immutable view a draw holds on to.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "raster/api/types.h"

namespace halfspace::raster {

// How a texture is looked up. Spec 3.8.4; border_color is used by Wrap::clamp with Filter::linear.
struct Sampler {
  Filter mag = Filter::linear;
  Filter min = Filter::nearest;
  MipMode mip = MipMode::linear;
  Wrap wrap_s = Wrap::repeat, wrap_t = Wrap::repeat;
  Color border_color;
  // The texture is one-dimensional: t counts neither for the texel (wrap_t must be repeat) nor for the level.
  bool one_dimensional = false;
  bool operator==(const Sampler&) const = default;
};

// One level in the form the sampler wants (raster/texture/level.h).
struct TextureLevel;

// What a draw samples: levels [0, level_count) complete, each half the size of the one before (at least 1),
// the sampler, and the base format of level 0. Copies share the levels.
struct TextureView {
  std::array<std::shared_ptr<const TextureLevel>, kMaxTextureLevels> levels;
  int level_count = 0;
  Sampler sampler;
  BaseFormat base_format = BaseFormat::rgba;

  size_t bytes() const;  // of memory that the levels take
};

// A texture's levels. Each level is defined alone, as GL does it; whether they fit together is the caller's
// question (spec 3.8.8 completeness). One-dimensional textures have height 1; with a border, the rows below and
// above hold the same texels as the row itself.
//
// Levels are copied on write: a view taken earlier keeps the texels it was taken with.
// Not thread-safe; out of memory throws std::bad_alloc and leaves the texture as it was.
class Texture {
 public:
  Texture();
  ~Texture();
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  // Defines `level` (0-based) as width x height texels plus `border` (0 or 1) texels on every side.
  // rgba: (width + 2*border) * (height + 2*border) texels, 4 bytes each in the order R, G, B, A, bottom row
  // first, rows `row_stride` bytes apart; null leaves the texels zero. Components that `base_format` lacks
  // must already hold what the spec's table 3.11 puts there (rgb: A = 255; luminance: R = G = B = L;
  // alpha: R = G = B = 0; intensity: R = G = B = A = I).
  void define_level(int level, int width, int height, int border, BaseFormat base_format, const uint8_t* rgba,
                    size_t row_stride);
  // The same from rows that are made one by one: rows(n) is called once for each n from 0 up and returns row n,
  // which has to last until the next call. It must not throw.
  using RowSource = std::function<const uint8_t*(int row)>;
  void define_level(int level, int width, int height, int border, BaseFormat base_format, const RowSource& rows);
  // Overwrites the texels [x, x+w) x [y, y+h); coordinates may reach from -border to size+border.
  void update_level(int level, int x, int y, int w, int h, const uint8_t* rgba, size_t row_stride);
  void update_level(int level, int x, int y, int w, int h, const RowSource& rows);
  // Reads a level back as define_level took it, border included.
  void read_level(int level, uint8_t* rgba, size_t row_stride) const;
  void remove_level(int level);

  struct LevelInfo {
    int width = 0, height = 0, border = 0;  // width and height without the border; 0 when undefined
    BaseFormat base_format = BaseFormat::rgba;
  };
  LevelInfo level_info(int level) const;

  // A view of levels [0, level_count) for `sampler`. Cheap when nothing changed since the last call.
  std::shared_ptr<const TextureView> view(const Sampler& sampler, int level_count);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace halfspace::raster
