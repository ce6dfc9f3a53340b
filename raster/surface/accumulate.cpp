#include "raster/surface/accumulate.h"

#include <algorithm>
#include <cmath>

namespace halfspace::raster {
namespace {

// A sum with what is twice as much, or more, saturates whatever the other addend is.
constexpr double kPlenty = 2.0 * (kAccumOne + 1);

// To the nearest unit of the accumulation buffer; NaN is 0.
int32_t to_units(double v) {
  const double units = v * kAccumOne;
  if (!(units > -kPlenty)) return units != units ? 0 : static_cast<int32_t>(-kPlenty);
  return static_cast<int32_t>(std::floor(std::min(units, kPlenty) + 0.5));
}

int16_t saturated(int32_t units) {
  return static_cast<int16_t>(std::clamp(units, static_cast<int32_t>(-kAccumOne), static_cast<int32_t>(kAccumOne)));
}

float unit_of(double units) {
  const double v = units / kAccumOne;
  return v > 0 ? static_cast<float>(std::min(v, 1.0)) : 0.0f;
}

}  // namespace

int16_t accum_fixed(float value) { return saturated(to_units(static_cast<double>(value))); }

// Pixels [x0, x1) x [y0, y1) of the block.
struct Accumulation::Block {
  size_t tile;
  int block;
  int x0, y0, x1, y1;
  // visit(i): pixel i of the block.
  template <class Visit>
  void for_pixels(Visit visit) const {
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) visit(y * kBlockSize + x);
  }
};

Accumulation::Accumulation(Framebuffer::Impl& framebuffer, const AccumCommand& command)
    : fb_(framebuffer), command_(command), rect_{0, 0, framebuffer.width, framebuffer.height} {
  if (command.scissor_test) rect_ = intersect(rect_, command.scissor);
  const bool takes = command.op == AccumOp::accum || command.op == AccumOp::load;
  if (command.op == AccumOp::return_ && !command.color_mask.none()) targets_ = fb_.existing(command.color_targets);
  fb_.need_accum();
  fb_.need_color(takes ? fb_.existing(command.read_plane) : targets_);
  for (int byte = 0; byte < 256; ++byte) terms_[byte] = to_units(static_cast<double>(command.value) * byte / 255.0);
}

void Accumulation::run(size_t tile) const {
  const Rect all = fb_.tile_rect(tile), part = intersect(all, rect_);
  if (part.empty()) return;
  constexpr uint64_t kAll = ~uint64_t{0};
  fb_.settle_accum(tile, kAll);
  if (command_.op == AccumOp::accum || command_.op == AccumOp::load)
    fb_.settle_color(tile, kAll, plane_index(command_.read_plane));
  for (const ColorPlane plane : {kBackPlane, kFrontPlane})
    if ((targets_ & plane) != 0) fb_.settle_color(tile, kAll, plane_index(plane));
  for (int block = 0; block < kTileBlocks; ++block) {
    const int x = all.x0 + block % 8 * kBlockSize, y = all.y0 + block / 8 * kBlockSize;
    const Rect inside = intersect({x, y, x + kBlockSize, y + kBlockSize}, part);
    if (!inside.empty()) run_block({tile, block, inside.x0 - x, inside.y0 - y, inside.x1 - x, inside.y1 - y});
  }
}

void Accumulation::run_block(const Block& block) const {
  switch (command_.op) {
    case AccumOp::accum:
    case AccumOp::load: return take_colors(block);
    case AccumOp::add:
    case AccumOp::mult: return change(block);
    case AccumOp::return_: break;
  }
  for (const ColorPlane plane : {kBackPlane, kFrontPlane})
    if ((targets_ & plane) != 0) give_back(block, plane_index(plane));
}

void Accumulation::take_colors(const Block& block) const {
  int16_t* sums = fb_.accum_tile(block.tile) + block.block * kBlockPixels * 4;
  const bool adds = command_.op == AccumOp::accum;
  const int plane = plane_index(command_.read_plane);
  if (fb_.format == ColorFormat::rgba8) {
    const uint32_t* colors = fb_.color_tile<uint32_t>(block.tile, plane) + block.block * kBlockPixels;
    block.for_pixels([&](int i) {
      for (int c = 0; c < 4; ++c) {
        int16_t& sum = sums[i * 4 + c];
        sum = saturated((adds ? sum : 0) + terms_[colors[i] >> (8 * c) & 255u]);
      }
    });
    return;
  }
  const float* channels = fb_.color_tile<float>(block.tile, plane) + block.block * kBlockPixels * 4;
  block.for_pixels([&](int i) {
    for (int c = 0; c < 4; ++c) {
      int16_t& sum = sums[i * 4 + c];
      const auto color = static_cast<double>(channels[c * kBlockPixels + i]);
      sum = saturated((adds ? sum : 0) + to_units(static_cast<double>(command_.value) * color));
    }
  });
}

void Accumulation::change(const Block& block) const {
  int16_t* sums = fb_.accum_tile(block.tile) + block.block * kBlockPixels * 4;
  const auto value = static_cast<double>(command_.value);
  const int32_t term = to_units(value);
  const bool adds = command_.op == AccumOp::add;
  block.for_pixels([&](int i) {
    for (int c = 0; c < 4; ++c) {
      int16_t& sum = sums[i * 4 + c];
      sum = saturated(adds ? sum + term : to_units(sum * value / kAccumOne));
    }
  });
}

void Accumulation::give_back(const Block& block, int plane) const {
  const int16_t* sums = fb_.accum_tile(block.tile) + block.block * kBlockPixels * 4;
  const auto value = static_cast<double>(command_.value);
  const ColorMask& mask = command_.color_mask;
  const bool on[4] = {mask.r, mask.g, mask.b, mask.a};
  if (fb_.format == ColorFormat::rgba8) {
    uint32_t* colors = fb_.color_tile<uint32_t>(block.tile, plane) + block.block * kBlockPixels;
    const uint32_t kept = ~((on[0] ? 0xffu : 0u) | (on[1] ? 0xff00u : 0u) | (on[2] ? 0xff0000u : 0u) |
                            (on[3] ? 0xff000000u : 0u));
    block.for_pixels([&](int i) {
      const int16_t* sum = sums + i * 4;
      const Color color{unit_of(sum[0] * value), unit_of(sum[1] * value), unit_of(sum[2] * value),
                        unit_of(sum[3] * value)};
      colors[i] = (colors[i] & kept) | (pack_rgba8(color) & ~kept);
    });
    return;
  }
  float* channels = fb_.color_tile<float>(block.tile, plane) + block.block * kBlockPixels * 4;
  block.for_pixels([&](int i) {
    for (int c = 0; c < 4; ++c)
      if (on[c]) channels[c * kBlockPixels + i] = unit_of(sums[i * 4 + c] * value);
  });
}

}  // namespace halfspace::raster
