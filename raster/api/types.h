// The vocabulary of the contract: enumerations and small values without any GL in them.
#pragma once

#include <cstdint>

namespace halfspace::raster {

enum class Primitive : uint8_t {
  points, lines, line_loop, line_strip, triangles, triangle_strip, triangle_fan, quads, quad_strip, polygon,
};
// Vertices of one primitive, for modes whose primitives stand alone; 0: the others.
constexpr uint32_t separate_vertices(Primitive mode) {
  switch (mode) {
    case Primitive::points: return 1;
    case Primitive::lines: return 2;
    case Primitive::triangles: return 3;
    case Primitive::quads: return 4;
    default: return 0;
  }
}
enum class CompareFunc : uint8_t { never, less, equal, less_equal, greater, not_equal, greater_equal, always };
enum class BlendFactor : uint8_t {
  zero, one, src_color, one_minus_src_color, dst_color, one_minus_dst_color,
  src_alpha, one_minus_src_alpha, dst_alpha, one_minus_dst_alpha, src_alpha_saturate,
};
enum class Wrap : uint8_t { repeat, clamp, clamp_to_edge };
enum class Filter : uint8_t { nearest, linear };
enum class MipMode : uint8_t { none, nearest, linear };
enum class BaseFormat : uint8_t { alpha, luminance, luminance_alpha, intensity, rgb, rgba };
enum class EnvMode : uint8_t { modulate, decal, blend, replace };
enum class ColorFormat : uint8_t { rgba8, rgba32f };
// A framebuffer has one colour plane or two; depth, stencil and accumulation serve both.
enum ColorPlane : uint8_t { kBackPlane = 1, kFrontPlane = 2 };  // a single-buffered one has the first only

// Half-open rectangle of pixels in GL window coordinates: x right, y up.
struct Rect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
  bool operator==(const Rect&) const = default;
};
inline Rect intersect(const Rect& a, const Rect& b) {
  return {a.x0 > b.x0 ? a.x0 : b.x0, a.y0 > b.y0 ? a.y0 : b.y0, a.x1 < b.x1 ? a.x1 : b.x1,
          a.y1 < b.y1 ? a.y1 : b.y1};
}

// Red, green, blue, alpha.
struct Color {
  float r = 0, g = 0, b = 0, a = 0;
  bool operator==(const Color&) const = default;
};

inline constexpr int kMaxTextureLevels = 15;
inline constexpr int kMaxTextureSize = 1 << (kMaxTextureLevels - 1);  // texels, without borders
inline constexpr int kMaxSurfaceSize = 16384;                         // pixels a side

}  // namespace halfspace::raster
