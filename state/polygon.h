// Polygon rasterisation state (spec 3.5).
#pragma once

#include <array>
#include <cstdint>

#include "state/gl_types.h"

namespace halfspace::state {

struct PolygonState {
  bool cull = false;
  GLenum cull_face = GL_BACK;
  GLenum front_face = GL_CCW;
  GLenum mode[2] = {GL_FILL, GL_FILL};  // front, back
  bool smooth = false;
  bool stipple = false;
  bool offset_point = false, offset_line = false, offset_fill = false;
  float offset_factor = 0, offset_units = 0;
};

// A group of its own (GL_POLYGON_STIPPLE_BIT).
struct PolygonStippleState {
  std::array<uint32_t, 32> pattern = all_ones();  // lowest row first, leftmost pixel in the highest bit

  static constexpr std::array<uint32_t, 32> all_ones() {
    std::array<uint32_t, 32> rows{};
    for (uint32_t& row : rows) row = ~0u;
    return rows;
  }
};

}  // namespace halfspace::state
