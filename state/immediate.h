// Begin/End (spec 2.6): vertices are gathered and drawn together. Points, lines, triangles and quads wait
// after End for the next Begin: while mode and state stay the same, many short pairs are one batch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "raster/api/draw_packet.h"
#include "state/gl_types.h"
#include "state/shared_vertices.h"

namespace halfspace::state {

struct Context;

// What is gathered of a vertex: x y z w, r g b a, and then what the state at Begin calls for, by fours.
struct VertexFormat {
  uint32_t floats = 8;     // of one vertex
  uint32_t tex_coord = 0;  // where s t r q stand, in floats; 0: nowhere
  uint32_t normal = 0;     // where x y z stand
  bool edge_flag = false;  // gathered aside
  bool rare = false;       // there is an edge flag or a material
  bool operator==(const VertexFormat&) const = default;
};
inline constexpr uint32_t kMaxVertexFloats = 16;
// What vertices of `mode` have under the state as it is.
VertexFormat vertex_format(const Context& context, GLenum mode);

// The longest batch. A multiple of 12, so that points, lines, triangles, quads and strips all part there
// cleanly.
inline constexpr uint32_t kMaxBatchVertices = 65532;
// The longest polygon that must not be parted.
inline constexpr uint32_t kMaxWholeVertices = 1u << 28;

struct ImmediateState {
  bool inside = false;        // between Begin and End
  bool color_varies = false;  // the colour was set since the batch's first vertex
  bool loop_parted = false;   // a line loop that was too long goes on as a strip; End closes it
  GLenum mode = GL_POINTS;    // as given to Begin
  float* cursor = nullptr;    // where the next vertex goes; cursor == limit: no room, or outside Begin/End
  float* limit = nullptr;
  uint32_t most_given = 0;     // vertices the buffer has room for
  bool strip_goes_on = false;  // a line strip was parted: its stipple runs on
  VertexFormat format;
  uint32_t longest = kMaxBatchVertices;  // vertices the batch may have
  float loop_first[kMaxVertexFloats];    // a parted loop's first vertex
  uint32_t loop_first_material = 0;
  std::vector<float> buffer;                       // room for kMaxVertexFloats a vertex
  std::vector<uint8_t> edge_flags;                 // one a vertex, if the format has them
  std::vector<raster::MaterialPair> materials;     // set since Begin, the one of Begin first; mostly none
  std::vector<uint32_t> material_index;            // one a vertex, if there are materials
  uint32_t waiting = 0;                            // vertices of closed pairs that are not drawn yet
  std::shared_ptr<const raster::DrawState> state;  // what the gathered vertices are drawn with

  SharedVertices shared;  // numbers what stands in the buffer, where it is active

  // In the buffer.
  uint32_t vertex_count() const { return uint32_t(size_t(cursor - buffer.data())) / format.floats; }
};

// glMaterial between Begin and End: vertices from now on have `pair`. May throw std::bad_alloc.
void gather_material(Context& context, const raster::MaterialPair& pair);

// Lets go of draw states that nothing is to be drawn with any more, and so of the textures they see: one
// whose image is about to be replaced may then take the new one where the old one lies.
void forget_state(Context& context);

// Draws what waits. Whoever draws, clears, reads or shows pixels by another way than state/color_buffer.h's
// functions calls this first.
void flush_vertices(Context& context);

}  // namespace halfspace::state
