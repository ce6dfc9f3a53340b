#include "raster/surface/clear.h"

#include <algorithm>

namespace halfspace::raster {
namespace {

Rect clear_rect(const Framebuffer::Impl& fb, const ClearCommand& command) {
  const Rect all{0, 0, fb.width, fb.height};
  return command.scissor_test ? intersect(all, command.scissor) : all;
}

uint32_t depth_to_24_bits(double depth) {
  const double clamped = depth > 0 ? std::min(depth, 1.0) : 0.0;
  return static_cast<uint32_t>(clamped * static_cast<double>(kDepthMax) + 0.5);
}

Color clamped(const Color& c) {
  auto one = [](float v) { return v > 0 ? std::min(v, 1.0f) : 0.0f; };
  return {one(c.r), one(c.g), one(c.b), one(c.a)};
}

uint32_t byte_mask(const ColorMask& mask) {
  return (mask.r ? 0xffu : 0u) | (mask.g ? 0xff00u : 0u) | (mask.b ? 0xff0000u : 0u) | (mask.a ? 0xff000000u : 0u);
}

// Which pixels of a tile a rectangle takes: whole blocks, and blocks it takes only a part of.
struct TileCut {
  uint64_t whole = 0, partial = 0;
};

TileCut cut_tile(const Rect& inside, const Rect& tile) {
  TileCut cut;
  for (int block = 0; block < kTileBlocks; ++block) {
    const int x = tile.x0 + block % 8 * kBlockSize, y = tile.y0 + block / 8 * kBlockSize;
    // Pixels beyond the framebuffer's edge are nobody's: a block it cuts is whole when all its real pixels are.
    const Rect real = intersect({x, y, x + kBlockSize, y + kBlockSize}, tile);
    const Rect taken = intersect(real, inside);
    if (taken.empty()) continue;
    (taken == real ? cut.whole : cut.partial) |= uint64_t{1} << block;
  }
  return cut;
}

template <class Visit>
void for_pixels(uint64_t blocks, const Rect& inside, const Rect& tile, Visit visit) {
  for (int block = 0; block < kTileBlocks; ++block) {
    if ((blocks >> block & 1) == 0) continue;
    const int x = tile.x0 + block % 8 * kBlockSize, y = tile.y0 + block / 8 * kBlockSize;
    const Rect taken = intersect({x, y, x + kBlockSize, y + kBlockSize}, inside);
    for (int py = taken.y0; py < taken.y1; ++py)
      for (int px = taken.x0; px < taken.x1; ++px) visit(block, (py - y) * kBlockSize + px - x);
  }
}

void clear_tile_color(Framebuffer::Impl& fb, size_t tile, const TileCut& cut, const Rect& inside,
                      const ClearCommand& command) {
  TileState& state = fb.tiles[tile];
  const Color value = fb.format == ColorFormat::rgba8 ? clamped(command.color_value) : command.color_value;
  const uint32_t packed = pack_rgba8(command.color_value);
  const bool masked = !command.color_mask.all();
  const uint64_t by_pixel = masked ? cut.whole | cut.partial : cut.partial;
  if (by_pixel != 0 || cut.whole != ~uint64_t{0}) fb.settle_color(tile, ~(masked ? 0 : cut.whole));
  if (by_pixel != 0) {
    if (fb.format == ColorFormat::rgba8) {
      const uint32_t mask = byte_mask(command.color_mask);
      uint32_t* pixels = fb.color_tile<uint32_t>(tile);
      for_pixels(by_pixel, inside, fb.tile_rect(tile), [&](int block, int i) {
        uint32_t& pixel = pixels[block * kBlockPixels + i];
        pixel = (packed & mask) | (pixel & ~mask);
      });
    } else {
      const float values[4] = {value.r, value.g, value.b, value.a};
      const bool on[4] = {command.color_mask.r, command.color_mask.g, command.color_mask.b, command.color_mask.a};
      float* pixels = fb.color_tile<float>(tile);
      for_pixels(by_pixel, inside, fb.tile_rect(tile), [&](int block, int i) {
        for (int c = 0; c < 4; ++c)
          if (on[c]) pixels[(block * 4 + c) * kBlockPixels + i] = values[c];
      });
    }
  }
  if (masked || cut.whole == 0) return;
  state.clear_rgba8 = packed;
  state.clear_color = value;
  state.color_is_clear |= cut.whole;
}

void clear_tile_depth(Framebuffer::Impl& fb, size_t tile, const TileCut& cut, const Rect& inside, uint32_t value) {
  TileState& state = fb.tiles[tile];
  if (cut.whole != ~uint64_t{0}) fb.settle_depth(tile, ~cut.whole);
  if (cut.partial != 0) {
    uint32_t* pixels = fb.depth_tile(tile);
    for_pixels(cut.partial, inside, fb.tile_rect(tile),
               [&](int block, int i) { pixels[block * kBlockPixels + i] = value; });
  }
  for (int block = 0; block < kTileBlocks; ++block) {
    if ((cut.whole >> block & 1) != 0) state.depth_max[block] = value;
    else if ((cut.partial >> block & 1) != 0) state.depth_max[block] = std::max(state.depth_max[block], value);
  }
  if (cut.whole == 0) return;
  state.clear_depth = value;
  state.depth_is_clear |= cut.whole;
}

}  // namespace

bool clears_everything(const Framebuffer::Impl& fb, const ClearCommand& command) {
  const bool everywhere = clear_rect(fb, command) == Rect{0, 0, fb.width, fb.height};
  return everywhere && (!command.color || command.color_mask.all()) && (!command.depth || command.depth_write);
}

void clear(Framebuffer::Impl& fb, const ClearCommand& command) {
  const Rect rect = clear_rect(fb, command);
  const bool color = command.color && !command.color_mask.none(), depth = command.depth && command.depth_write;
  if (rect.empty()) return;
  if (!clears_everything(fb, command)) {
    // Only then may pixels have to be written one by one.
    if (color) fb.need_color();
    if (depth) fb.need_depth();
  }
  const uint32_t depth_value = depth_to_24_bits(command.depth_value);
  for (int ty = rect.y0 / kTileSize; ty * kTileSize < rect.y1; ++ty) {
    for (int tx = rect.x0 / kTileSize; tx * kTileSize < rect.x1; ++tx) {
      const size_t tile = static_cast<size_t>(ty) * static_cast<size_t>(fb.tiles_x) + static_cast<size_t>(tx);
      const Rect bounds = fb.tile_rect(tile);
      TileCut cut;
      if (intersect(bounds, rect) == bounds) cut.whole = ~uint64_t{0};
      else cut = cut_tile(rect, bounds);
      if (color) clear_tile_color(fb, tile, cut, rect, command);
      if (depth) clear_tile_depth(fb, tile, cut, rect, depth_value);
    }
  }
}

}  // namespace halfspace::raster
