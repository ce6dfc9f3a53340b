// Texture coordinates of one vertex, all four of them: generation (spec 2.11.4), then the texture matrix. The
// vertex stage proper makes only those which a texture lookup asks for.
#pragma once

#include "raster/api/draw_packet.h"

namespace halfspace::raster {

// `out`: s, t, r, q of vertex 0 of the batch.
void full_tex_coord(const DrawState& state, const VertexBatch& batch, double out[4]);

}  // namespace halfspace::raster
