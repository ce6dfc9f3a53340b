// Attributes of vertices at the exact level of the transform axis: lighting, texture coordinates and distance from the
// eye in double, each kept as the nearest float and what that leaves.
#pragma once

#include <cstddef>
#include <span>

#include "raster/api/draw_packet.h"
#include "raster/vertex/shaded_vertices.h"

namespace halfspace::raster {

// Writes them over what the kernels have left in `records`, of the vertices [first, first + count) of the batch.
// tex_coord_count: s t, s t q or s t r q.
void shade_exactly(const DrawState& state, const VertexBatch& batch, std::span<const MaterialPair> materials,
                   const VertexLayout& layout, int tex_coord_count, uint32_t first, uint32_t count, std::byte* records);

}  // namespace halfspace::raster
