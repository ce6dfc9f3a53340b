#include "tests/oracle/buffers.h"

#include <algorithm>

#include "tests/oracle/surface.h"

namespace halfspace::oracle {
namespace {

constexpr Real kAccumOne = 32767;  // 1.0 in the accumulation buffer

template <class Visit>
void for_pixels(const Target& target, const raster::Rect& rect, Visit visit) {
  const raster::Rect inside = intersect(target.bounds(), rect);
  for (int y = inside.y0; y < inside.y1; ++y)
    for (int x = inside.x0; x < inside.x1; ++x) visit(target.at(x, y));
}

std::array<float, 4> components(const raster::Color& c) { return {c.r, c.g, c.b, c.a}; }
std::array<bool, 4> components(const raster::ColorMask& m) { return {m.r, m.g, m.b, m.a}; }

ColorPixel stored_color(const std::array<float, 4>& color, raster::ColorFormat format) {
  ColorPixel pixel;
  const bool bytes = format == raster::ColorFormat::rgba8;
  for (size_t k = 0; k < 4; ++k) {
    const Real level = real(color[k]) * 255;
    pixel.value[k] = color[k];
    pixel.level[k] = static_cast<float>(bytes ? held(level, 0.0L, 255.0L) : level);
    pixel.byte[k] = pixel.low[k] = pixel.high[k] = byte_of(level);
  }
  return pixel;
}

void take(const ColorPixel& from, const std::array<bool, 4>& on, ColorPixel& to) {
  for (size_t k = 0; k < 4; ++k) {
    if (!on[k]) continue;
    to.level[k] = from.level[k], to.value[k] = from.value[k];
    to.byte[k] = from.byte[k], to.low[k] = from.low[k], to.high[k] = from.high[k];
  }
}

int16_t units(Real v) {
  const Real rounded = std::floor(v + 0.5L);
  return v == v ? static_cast<int16_t>(held(rounded, -kAccumOne, kAccumOne)) : int16_t{0};
}

// What is in a colour buffer, in [0, 1].
Real color_of(const Target& target, const ColorPixel& pixel, size_t k) {
  return target.format == raster::ColorFormat::rgba8 ? pixel.byte[k] / 255.0L : real(pixel.value[k]);
}

template <class Visit>
void for_planes(Target& target, uint8_t planes, Visit visit) {
  for (const raster::ColorPlane plane : {raster::kBackPlane, raster::kFrontPlane}) {
    std::vector<ColorPixel>& pixels = target.color[static_cast<size_t>(place_of_plane(plane))];
    if ((planes & plane) != 0 && !pixels.empty()) visit(pixels);
  }
}

}  // namespace

// Spec 4.2.3.
void clear(Target& target, const raster::ClearCommand& c) {
  const raster::Rect rect = c.scissor_test ? c.scissor : target.bounds();
  if (c.color && !c.color_mask.none()) {
    const ColorPixel color = stored_color(components(c.color_value), target.format);
    for_planes(target, c.color_targets, [&](std::vector<ColorPixel>& pixels) {
      for_pixels(target, rect, [&](size_t at) {
        take(color, components(c.color_mask), pixels[at]);
        target.owner[at] = {0, 0, target.owner[at].doubtful && !c.color_mask.all()};
      });
    });
  }
  if (c.depth && c.depth_write) {
    const Real depth = held(real(c.depth_value), 0.0L, 1.0L) * kDepthSteps;
    const auto step = static_cast<uint32_t>(std::floor(depth + 0.5L));
    for_pixels(target, rect, [&](size_t at) {
      target.depth[at] = {static_cast<double>(depth), step, step, step};
    });
  }
  if (c.stencil) {
    for_pixels(target, rect, [&](size_t at) {
      uint8_t& stored = target.stencil[at];
      stored = static_cast<uint8_t>((c.stencil_value & c.stencil_mask) | (stored & ~c.stencil_mask));
    });
  }
  if (c.accum) {
    std::array<int16_t, 4> value;
    for (size_t k = 0; k < 4; ++k) value[k] = units(real(components(c.accum_value)[k]) * kAccumOne);
    for_pixels(target, rect, [&](size_t at) { target.accum[at] = value; });
  }
}

// Spec 4.2.4. Sums saturate.
void accumulate(Target& target, const raster::AccumCommand& c) {
  const raster::Rect rect = c.scissor_test ? c.scissor : target.bounds();
  const Real value = real(c.value);
  const std::vector<ColorPixel>& read = target.color[static_cast<size_t>(place_of_plane(c.read_plane))];
  for_pixels(target, rect, [&](size_t at) {
    for (size_t k = 0; k < 4; ++k) {
      int16_t& sum = target.accum[at][k];
      switch (c.op) {
        case raster::AccumOp::load:
          sum = units(value * color_of(target, read[at], k) * kAccumOne);
          break;
        case raster::AccumOp::accum: {
          // The term is in the buffer's units before it is added, as wide as it comes.
          const Real term = std::floor(value * color_of(target, read[at], k) * kAccumOne + 0.5L);
          sum = units(sum + term);
          break;
        }
        case raster::AccumOp::add:
          sum = units(sum + std::floor(value * kAccumOne + 0.5L));
          break;
        case raster::AccumOp::mult:
          sum = units(sum * value);
          break;
        case raster::AccumOp::return_:
          break;
      }
    }
  });
  if (c.op != raster::AccumOp::return_ || c.color_mask.none()) return;
  for_planes(target, c.color_targets, [&](std::vector<ColorPixel>& pixels) {
    for_pixels(target, rect, [&](size_t at) {
      std::array<float, 4> color;
      for (size_t k = 0; k < 4; ++k)
        color[k] = static_cast<float>(held(target.accum[at][k] * value / kAccumOne, 0.0L, 1.0L));
      take(stored_color(color, target.format), components(c.color_mask), pixels[at]);
    });
  });
}

void copy_plane(Target& target, raster::ColorPlane from, raster::ColorPlane to, const raster::Rect& rect) {
  const auto& source = target.color[static_cast<size_t>(place_of_plane(from))];
  auto& destination = target.color[static_cast<size_t>(place_of_plane(to))];
  if (source.empty() || destination.empty()) return;
  for_pixels(target, rect, [&](size_t at) { destination[at] = source[at]; });
}

}  // namespace halfspace::oracle
