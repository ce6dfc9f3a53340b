// Texture coordinate generation (spec 2.11.4).
#pragma once

#include <array>

#include "raster/api/types.h"

namespace halfspace::raster {

enum class TexGenMode : uint8_t { off, object_linear, eye_linear, sphere_map };  // sphere_map: s and t only

struct TexGenCoord {
  TexGenMode mode = TexGenMode::off;
  std::array<double, 4> object_plane{};
  std::array<double, 4> eye_plane{};  // already multiplied by the inverse modelview of when it was given
};

struct TexGenState {
  std::array<TexGenCoord, 4> coord;  // s, t, r, q
  bool any() const {
    for (const TexGenCoord& c : coord)
      if (c.mode != TexGenMode::off) return true;
    return false;
  }
};

}  // namespace halfspace::raster
