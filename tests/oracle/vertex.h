// One vertex of a draw: transformed, lit, with its texture coordinates (spec 2.11, 2.14).
#pragma once

#include <span>

#include "raster/api/draw_packet.h"
#include "tests/oracle/corner.h"

namespace halfspace::oracle {

struct Vertex {
  Corner corner;               // with the colour of the front
  std::array<Wide, 4> back{};  // the colour on polygons that face away
  bool usable = true;          // every clip coordinate is a finite double; primitives of others are dropped
  // A light is so near to where its part jumps (n . L = 0, the rim of a spot) that rounding may decide.
  bool doubtful = false;
};

Vertex shade_vertex(const raster::DrawState& state, const raster::VertexBatch& batch,
                    std::span<const raster::MaterialPair> materials, uint32_t index);

}  // namespace halfspace::oracle
