// glPixelMap (spec 3.6.3): tables in which pixel transfer looks components and indices up.
#pragma once

#include <array>

#include "state/gl_types.h"

namespace halfspace::state {

inline constexpr GLsizei kMaxPixelMapSize = 256;

struct PixelMap {
  GLsizei size = 1;                              // entries, 1 .. kMaxPixelMapSize
  std::array<float, kMaxPixelMapSize> values{};  // components in [0, 1]; of I_TO_I and S_TO_S whole numbers
};

struct PixelMapState {
  std::array<PixelMap, 10> maps;  // GL_PIXEL_MAP_I_TO_I .. GL_PIXEL_MAP_A_TO_A
  // `name`: one of these ten.
  const PixelMap& operator[](GLenum name) const { return maps[name - GL_PIXEL_MAP_I_TO_I]; }
};

}  // namespace halfspace::state
