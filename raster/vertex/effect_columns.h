// What only some draws ask of the vertex stage, a column a component. Plain arrays, for the per-ISA kernels.
#pragma once

#include <cstdint>

namespace halfspace::raster {

// Vertices taken at once: their columns stay in L1. A multiple of every vector length.
inline constexpr uint32_t kVertexGroup = 32;

struct alignas(64) EffectColumns {
  double eye[3][kVertexGroup];    // eye coordinates, divided by w
  float normal[3][kVertexGroup];  // in eye coordinates; of length 1 under GL_NORMALIZE
  float color[4][kVertexGroup];   // the vertex's own, not clamped
  float lit[2][4][kVertexGroup];  // front, back; in [0, 1]
};

// A group's materials where vertices have different ones.
struct alignas(64) MaterialColumns {
  float ambient[4][kVertexGroup], diffuse[4][kVertexGroup], specular[4][kVertexGroup],
      emission[4][kVertexGroup];
  float shininess[kVertexGroup];
};

}  // namespace halfspace::raster
