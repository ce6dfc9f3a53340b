// Texture coordinate generation (spec 2.11.4).
#pragma once

#include <array>

#include "raster/api/tex_gen.h"
#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

struct TexGenCoordState {
  bool enabled = false;
  GLenum mode = GL_EYE_LINEAR;
  std::array<double, 4> object_plane{};
  std::array<double, 4> eye_plane{};  // through the inverse modelview of when it was given
};

struct TexGenState {
  std::array<TexGenCoordState, 4> coord;  // s, t, r, q
  TexGenState() {
    coord[0].object_plane = coord[0].eye_plane = {1, 0, 0, 0};
    coord[1].object_plane = coord[1].eye_plane = {0, 1, 0, 0};
  }
};

// Which coordinates are generated: of no effect without a texture.
raster::TexGenState derive_tex_gen(const TexGenState& state);

// Whether a coordinate is made from the normal.
inline bool generates_from_normals(const TexGenState& state) {
  for (const TexGenCoordState& c : state.coord)
    if (c.enabled && c.mode == GL_SPHERE_MAP) return true;
  return false;
}

}  // namespace halfspace::state
