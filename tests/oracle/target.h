// A framebuffer as the oracle keeps it: beside what is stored, what is true before it is rounded to be
// stored, who wrote it, and how far a correct renderer may be off.
#pragma once

#include <array>
#include <vector>

#include "raster/api/types.h"
#include "tests/oracle/number.h"

namespace halfspace::oracle {

struct ColorPixel {
  std::array<float, 4> level{};   // R, G, B, A before rounding, 0 .. 255
  std::array<uint8_t, 4> byte{};  // rounded; what later blending starts from
  // What may be stored where a correct renderer's colours are a little off before rounding.
  std::array<uint8_t, 4> low{}, high{};
  std::array<float, 4> value{};  // of a float framebuffer
};

struct DepthPixel {
  double exact = 0;  // 0 .. 2^24 - 1
  uint32_t stored = 0;
  uint32_t low = 0, high = 0;  // what may be stored
};

struct PixelOwner {
  uint32_t primitive = 0, draw = 0;  // of the frame, from 1; 0: the background
  bool doubtful = false;             // a test was decided by less than rounding may change
};

inline constexpr Real kLevelDoubt = 0.05L;  // of 255 levels: the standard level promises 0.55 after rounding
inline constexpr Real kDepthDoubt = 0.03L;  // of a step

struct Target {
  int width, height;
  raster::ColorFormat format;
  std::array<std::vector<ColorPixel>, 2> color;  // by plane; the second one may be missing
  std::vector<DepthPixel> depth;
  std::vector<uint8_t> stencil;
  std::vector<std::array<int16_t, 4>> accum;
  std::vector<PixelOwner> owner;

  Target(int w, int h, raster::ColorFormat f, int planes)
      : width(w), height(h), format(f), depth(pixels()), stencil(pixels()), accum(pixels()), owner(pixels()) {
    for (int i = 0; i < planes; ++i) color[static_cast<size_t>(i)].resize(pixels());
  }
  size_t pixels() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
  size_t at(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  }
  raster::Rect bounds() const { return {0, 0, width, height}; }
};

inline int place_of_plane(raster::ColorPlane plane) { return plane == raster::kFrontPlane ? 1 : 0; }

// Nearest of 0 .. 255.
inline uint8_t byte_of(Real level) { return static_cast<uint8_t>(held(level, 0.0L, 255.0L) + 0.5L); }

}  // namespace halfspace::oracle
