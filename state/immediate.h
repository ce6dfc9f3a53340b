// Begin/End (spec 2.6): vertices are gathered and drawn together. Points, lines, triangles and quads wait
// after End for the next Begin: while mode and state stay the same, many short pairs are one batch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "raster/api/draw_state.h"
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
  uint32_t waiting = 0;                            // vertices of closed pairs that are not drawn yet
  std::shared_ptr<const raster::DrawState> state;  // what the gathered vertices are drawn with

  uint32_t vertex_floats() const { return textured ? kTexturedVertexFloats : kPlainVertexFloats; }
  uint32_t vertex_count() const { return uint32_t(size_t(cursor - buffer.data()) / vertex_floats()); }
};

// Draws what waits. Whoever draws, clears, reads or shows pixels by another way than state/color_buffer.h's
// functions calls this first.
void flush_vertices(Context& context);

}  // namespace halfspace::state
