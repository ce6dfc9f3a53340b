#include "raster/surface/clear.h"

#include <algorithm>

#include "raster/surface/accumulate.h"

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

// A tile, and what a clear takes of it.
struct TileClear {
  Framebuffer::Impl& fb;
  size_t tile;
  TileCut cut;
  const Rect& inside;

  TileState& state() const { return fb.tiles[tile]; }
  // Marks of all blocks but the whole ones have to go before the clear value changes, and before pixels are written.
  // With a mask, pixels of whole blocks are written too.
  uint64_t to_settle(bool masked) const { return masked ? ~uint64_t{0} : ~cut.whole; }
  uint64_t by_pixel(bool masked) const { return masked ? cut.whole | cut.partial : cut.partial; }
  template <class Visit>
  void visit_pixels(bool masked, Visit visit) const {
    for_pixels(by_pixel(masked), inside, fb.tile_rect(tile), visit);
  }
};

void clear_bytes(const TileClear& at, int plane, const ColorMask& color_mask, uint32_t packed) {
  const uint32_t mask = byte_mask(color_mask);
  uint32_t* pixels = at.fb.color_tile<uint32_t>(at.tile, plane);
  at.visit_pixels(!color_mask.all(), [&](int block, int i) {
    uint32_t& pixel = pixels[block * kBlockPixels + i];
    pixel = (packed & mask) | (pixel & ~mask);
  });
}

void clear_floats(const TileClear& at, int plane, const ColorMask& mask, const Color& value) {
  const float values[4] = {value.r, value.g, value.b, value.a};
  const bool on[4] = {mask.r, mask.g, mask.b, mask.a};
  float* pixels = at.fb.color_tile<float>(at.tile, plane);
  at.visit_pixels(!mask.all(), [&](int block, int i) {
    for (int c = 0; c < 4; ++c)
      if (on[c]) pixels[(block * 4 + c) * kBlockPixels + i] = values[c];
  });
}

void clear_tile_color(const TileClear& at, int plane, const ClearCommand& command, uint32_t packed) {
  const bool bytes = at.fb.format == ColorFormat::rgba8;
  const Color value = bytes ? clamped(command.color_value) : command.color_value;
  const bool masked = !command.color_mask.all();
  if (at.to_settle(masked) != 0) at.fb.settle_color(at.tile, at.to_settle(masked), plane);
  if (at.by_pixel(masked) != 0) {
    if (bytes) clear_bytes(at, plane, command.color_mask, packed);
    else clear_floats(at, plane, command.color_mask, value);
  }
  if (masked || at.cut.whole == 0) return;
  ColorMarks& marks = at.state().color[plane];
  marks.rgba8 = packed;
  marks.value = value;
  marks.is_clear |= at.cut.whole;
}

void clear_tile_depth(const TileClear& at, uint32_t value) {
  TileState& state = at.state();
  const TileCut& cut = at.cut;
  if (at.to_settle(false) != 0) at.fb.settle_depth(at.tile, at.to_settle(false));
  if (cut.partial != 0) {
    uint32_t* pixels = at.fb.depth_tile(at.tile);
    at.visit_pixels(false, [&](int block, int i) { pixels[block * kBlockPixels + i] = value; });
  }
  if (cut.whole == ~uint64_t{0}) {
    std::fill_n(state.depth_max, kTileBlocks, value);
    std::fill_n(state.depth_min, kTileBlocks, value);
  } else {
    for (int block = 0; block < kTileBlocks; ++block) {
      if ((cut.whole >> block & 1) != 0) state.depth_max[block] = state.depth_min[block] = value;
      else if ((cut.partial >> block & 1) != 0) state.depth_max[block] = std::max(state.depth_max[block], value);
    }
  }
  state.depth_min_holds = (state.depth_min_holds & ~cut.partial) | cut.whole;
  if (cut.whole == 0) return;
  state.clear_depth = value;
  state.depth_is_clear |= cut.whole;
  state.depth_on_plane &= ~cut.whole;
}

void clear_tile_stencil(const TileClear& at, uint8_t value, uint8_t mask) {
  const bool masked = mask != 0xff;
  if (at.to_settle(masked) != 0) at.fb.settle_stencil(at.tile, at.to_settle(masked));
  if (at.by_pixel(masked) != 0) {
    uint8_t* pixels = at.fb.stencil_tile(at.tile);
    at.visit_pixels(masked, [&](int block, int i) {
      uint8_t& pixel = pixels[block * kBlockPixels + i];
      pixel = static_cast<uint8_t>((value & mask) | (pixel & ~mask));
    });
  }
  if (masked || at.cut.whole == 0) return;
  at.state().clear_stencil = value;
  at.state().stencil_is_clear |= at.cut.whole;
}

void clear_tile_accum(const TileClear& at, const int16_t value[4]) {
  if (at.to_settle(false) != 0) at.fb.settle_accum(at.tile, at.to_settle(false));
  if (at.cut.partial != 0) {
    int16_t* pixels = at.fb.accum_tile(at.tile);
    at.visit_pixels(false, [&](int block, int i) { std::copy_n(value, 4, pixels + (block * kBlockPixels + i) * 4); });
  }
  if (at.cut.whole == 0) return;
  std::copy_n(value, 4, at.state().clear_accum);
  at.state().accum_is_clear |= at.cut.whole;
}

// `packed`: the colour in bytes.
void clear_tile(const TileClear& at, const ClearCommand& command, uint8_t targets, uint32_t packed) {
  for (const ColorPlane plane : {kBackPlane, kFrontPlane})
    if ((targets & plane) != 0) clear_tile_color(at, plane_index(plane), command, packed);
  if (command.depth && command.depth_write) clear_tile_depth(at, depth_to_24_bits(command.depth_value));
  if (command.stencil && command.stencil_mask != 0)
    clear_tile_stencil(at, command.stencil_value, command.stencil_mask);
  if (command.accum) {
    const int16_t value[4] = {accum_fixed(command.accum_value.r), accum_fixed(command.accum_value.g),
                              accum_fixed(command.accum_value.b), accum_fixed(command.accum_value.a)};
    clear_tile_accum(at, value);
  }
}

}  // namespace

bool clears_everything(const Framebuffer::Impl& fb, const ClearCommand& command) {
  const bool everywhere = clear_rect(fb, command) == Rect{0, 0, fb.width, fb.height};
  return everywhere && (!command.color || command.color_mask.all()) && (!command.depth || command.depth_write) &&
         (!command.stencil || command.stencil_mask == 0xff);
}

void clear(Framebuffer::Impl& fb, const ClearCommand& command) {
  const Rect rect = clear_rect(fb, command);
  if (rect.empty()) return;
  const uint8_t targets =
      command.color && !command.color_mask.none() ? fb.existing(command.color_targets) : uint8_t{0};
  if (!clears_everything(fb, command)) {
    // Only then may pixels have to be written one by one.
    fb.need_color(targets);
    if (command.depth && command.depth_write) fb.need_depth();
    if (command.stencil && command.stencil_mask != 0) fb.need_stencil();
    if (command.accum) fb.need_accum();
  }
  const uint32_t packed = pack_rgba8(command.color_value);
  for (int ty = rect.y0 / kTileSize; ty * kTileSize < rect.y1; ++ty) {
    for (int tx = rect.x0 / kTileSize; tx * kTileSize < rect.x1; ++tx) {
      const size_t tile = static_cast<size_t>(ty) * static_cast<size_t>(fb.tiles_x) + static_cast<size_t>(tx);
      const int x = tx * kTileSize, y = ty * kTileSize;
      const Rect bounds{x, y, std::min(x + kTileSize, fb.width), std::min(y + kTileSize, fb.height)};
      TileCut cut;
      if (intersect(bounds, rect) == bounds) cut.whole = ~uint64_t{0};
      else cut = cut_tile(rect, bounds);
      clear_tile({fb, tile, cut, rect}, command, targets, packed);
    }
  }
}

}  // namespace halfspace::raster
