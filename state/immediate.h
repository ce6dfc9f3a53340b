// Begin/End (spec 2.6): vertices are gathered, and drawn at End or when the buffer is full.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

// A gathered vertex: x y z w, r g b a, and s t r q when a texture is on.
inline constexpr uint32_t kPlainVertexFloats = 8;
inline constexpr uint32_t kTexturedVertexFloats = 12;
// The longest batch. A multiple of 12, so that points, lines, triangles, quads and strips all part there
// cleanly.
inline constexpr uint32_t kMaxBatchVertices = 65532;

struct ImmediateState {
  bool inside = false;        // between Begin and End
  bool color_varies = false;  // the colour changed since the batch's first vertex
  bool textured = false;
  bool loop_parted = false;  // a line loop that was too long goes on as a strip; End closes it
  GLenum mode = GL_POINTS;   // as given to Begin
  float* cursor = nullptr;   // where the next vertex goes; cursor == limit: no room, or outside Begin/End
  float* limit = nullptr;
  float loop_first[kTexturedVertexFloats];  // a parted loop's first vertex
  std::vector<float> buffer;

  uint32_t vertex_floats() const { return textured ? kTexturedVertexFloats : kPlainVertexFloats; }
  uint32_t vertex_count() const { return uint32_t(size_t(cursor - buffer.data()) / vertex_floats()); }
};

}  // namespace halfspace::state
