// Assembly of draws whose primitives are not simply filled triangles, lines and points of one pixel: user
// clip planes, polygon modes, wide, smooth and stippled lines, large and smooth points, smooth polygons.
#pragma once

#include "raster/primitive/segment.h"

namespace halfspace::raster {

// As assemble(). Where lines are stippled the draw comes in one range.
void assemble_shapes(const DrawRecord& draw, Primitive mode, const uint32_t* indices, uint32_t index_count,
                     uint32_t first, uint32_t count, Segment& segment);

// Signed distances of the batch's vertices from the user planes in use, kMaxClipPlanes a vertex (0 for the
// others), and for each vertex the planes it lies outside of. The planes are in eye coordinates; distances
// are linear over a primitive, so the projection does not come into it and may be singular.
void clip_distances(const DrawState& state, const VertexBatch& batch, double* distances, uint8_t* codes);

// Where the stipple stands after a line (coverage.h has its units).
uint32_t stipple_after(const ShapePlan& plan, const LineState& line, uint32_t start, const CutTriangle& ends);

}  // namespace halfspace::raster
