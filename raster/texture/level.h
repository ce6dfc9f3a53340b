// One mip level as the sampler reads it: 8-bit RGBA with a skirt, so that a bilinear footprint never wraps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

#include "raster/api/texture.h"
#include "raster/surface/page_buffer.h"

namespace halfspace::raster {

// What the skirt of a level was filled for. border_texel counts only where an axis is Wrap::clamp and the
// level has no border texels of its own.
struct SkirtKey {
  Wrap wrap_s = Wrap::repeat, wrap_t = Wrap::repeat;
  uint32_t border_texel = 0;
  bool operator==(const SkirtKey&) const = default;
};

struct AlignedDelete {
  void operator()(uint32_t* p) const { ::operator delete[](p, std::align_val_t{64}); }
};

// Texels are uint32_t with R in the lowest byte, then G, B, A. Texel (i, j), i in [-1, width], j in [-1,
// height], is base[(j + 1) * pitch + (i + 1)]; (0, 0) is the lowest left one. What lies outside the image is
// the skirt:
//   repeat: the texel of the opposite side; clamp_to_edge: the nearest edge texel;
//   clamp: the level's border texel, or the sampler's border colour when it has none.
// A corner obeys both axes; if either leaves the image by clamping, it is a border texel. One texel of
// padding follows the last row, so that a 64-bit load of two texels may begin at any texel.
struct TextureLevel {
  int width = 0, height = 0;       // texels, without skirt and border
  int pitch = 0;                   // texels from row to row: width + 2
  const uint32_t* base = nullptr;  // 64-byte aligned
  bool opaque = false;             // true: every texel a lookup can see, skirt included, has alpha 255

  // Each texel of `base` but those of the last row, and after it the one above: a bilinear footprint is then
  // 16 bytes on end. Of all levels of a view where the first has it; small textures that were looked up so do,
  // for twice their memory.
  std::unique_ptr<uint32_t[], AlignedDelete> stacked;

  uint32_t texel(int i, int j) const { return base[ptrdiff_t(j + 1) * pitch + (i + 1)]; }

  // The rest belongs to raster/texture/texture.cpp.
  uint32_t* texels = nullptr;  // `base`, in one of the two
  std::unique_ptr<uint32_t[], AlignedDelete> storage;
  PageBuffer pages;  // large images that start as zeros: no page of them exists before it is written
  int border = 0;
  BaseFormat base_format = BaseFormat::rgba;
  std::vector<uint32_t>
      border_texels;  // with border 1: bottom row, top row (width + 2 each), left, right column
  SkirtKey skirt;
  bool skirt_valid = false;
  bool image_opaque = false;  // true: every texel has alpha 255 (not found again once a write has lost it)
};

}  // namespace halfspace::raster
