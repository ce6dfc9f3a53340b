// The vertex stage: object coordinates to snapped window coordinates, SIMD over vertices.
#pragma once

#include "raster/api/draw_packet.h"
#include "raster/vertex/shaded_vertices.h"

namespace halfspace::raster {

// The layout `batch` needs under `state`: colour only if it varies, texture coordinates only if a texture is on,
// q only if it can differ from 1.
VertexLayout choose_layout(const DrawState& state, const VertexBatch& batch);

// Shades vertices [first, first + count) of the batch into out.records / outcodes / clip (sized by the caller to
// batch.count). Ranges may be shaded by different threads at once.
void shade_vertices(const DrawState& state, const VertexBatch& batch, uint32_t first, uint32_t count,
                    ShadedVertices& out);

}  // namespace halfspace::raster
