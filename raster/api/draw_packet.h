// One draw: vertices, the order to take them in, and the state.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>

#include "raster/api/draw_state.h"
#include "raster/api/index_ranges.h"

namespace halfspace::raster {

// Float components of one attribute, `size` (1..4) of them a vertex, `stride` bytes from vertex to vertex;
// no alignment is asked for. Missing components are 0, 0, 0, 1. stride 0: one value for all vertices, which
// the pipeline takes as "constant" and never interpolates.
struct AttributeStream {
  const void* data = nullptr;  // null: the attribute's default, (0,0,0,1); colour: (1,1,1,1)
  size_t stride = 0;
  uint8_t size = 4;
  // Colours only: four bytes a vertex, 255 is 1. `size` is 4. The float is the nearest to the quotient.
  bool bytes = false;
};

// An element's components; missing ones are left as they are.
inline void read_element(const AttributeStream& stream, uint32_t vertex, float (&v)[4]) {
  const auto* from = static_cast<const unsigned char*>(stream.data) + size_t{vertex} * stream.stride;
  if (stream.bytes) {
    for (int k = 0; k < 4; ++k) v[k] = static_cast<float>(from[k]) / 255.0f;
    return;
  }
  // Not one copy of a size that is only known here: to start one takes longer than these.
  for (size_t k = 0; k < 4; ++k)
    if (k < stream.size) std::memcpy(v + k, from + k * sizeof(float), sizeof(float));
}

struct VertexBatch {
  AttributeStream position;
  AttributeStream color;
  AttributeStream tex_coord;  // s, t, r, q
  AttributeStream normal;     // x, y, z; read where lighting or texgen calls for it. Default (0, 0, 1)
  // One byte a vertex: whether the polygon edge that starts there is drawn where the polygon mode is not
  // fill. Null: all.
  const uint8_t* edge_flag = nullptr;
  // A pair of DrawPacket::materials for each vertex. Null: DrawState::lighting.material for all.
  const uint32_t* material_index = nullptr;
  uint32_t count = 0;  // vertices; the streams hold elements 0 .. count-1
};

// indices: null takes the vertices 0, 1, 2 ... index_count - 1 in turn. Every index must be < batch.count.
// Nothing is kept of the streams or the indices once Device::draw has returned.
struct DrawPacket {
  std::shared_ptr<const DrawState> state;
  Primitive primitive = Primitive::triangles;
  VertexBatch batch;
  const uint32_t* indices = nullptr;
  uint32_t index_count = 0;
  // Of each stretch of the indices. Null: not known.
  const IndexRange* index_ranges = nullptr;
  // A line strip that goes on where the draw before this one ended: the line stipple runs on.
  bool continues = false;
  // The vertices came one by one: who makes such draws has more to do than who shades them.
  bool gathered = false;
  std::span<const MaterialPair> materials;
};

}  // namespace halfspace::raster
