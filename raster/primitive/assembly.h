// Assembly: vertices to primitives; rejects, culls, clips, and bins what is left.
#pragma once

#include "raster/primitive/segment.h"

namespace halfspace::raster {

// How many primitives (triangles, lines, points) `vertex_count` vertices of `mode` make; incomplete ones are
// dropped as spec 2.6.1 says.
uint32_t primitive_count(Primitive mode, uint32_t vertex_count);

// Assembles primitives [first, first + count) of the draw (0 <= first, first + count <= primitive_count), takes
// them through rejection, clipping and culling, and appends what can cover a pixel centre of draw.bounds to
// `segment`. indices: as in DrawPacket. Any range may be assembled alone: ranges split a draw over threads.
void assemble(const DrawRecord& draw, Primitive mode, const uint32_t* indices, uint32_t index_count,
              uint32_t first, uint32_t count, Segment& segment);

}  // namespace halfspace::raster
