// Points and lines of one pixel's width that take a short way to memory.
#pragma once

#include "raster/primitive/point_packet.h"
#include "raster/primitive/segment.h"

namespace halfspace::raster {

// What decides about a draw's way before there is a record of it.
struct DrawPlan {
  const DrawState& state;
  const VertexLayout& layout;
  const ShapePlan& shape;
  const PipelineProgram& program;
};

// Whether a point's colour is all that its fragment is made from: it then waits with the fragments of small
// triangles, without any set-up. At standard accuracy the colour is the same float whether a plane in float
// or one in double gives it.
bool points_wait(const VertexLayout& layout, const ShapePlan& shape, const PipelineProgram& program);

// Whether such a draw's points, each of its own colour, are binned as runs.
bool points_run(const DrawPlan& draw, Primitive mode);

// Whether nothing but runs is made from their vertices, each of which is named once.
bool points_run_unshaded(const DrawPlan& draw, const DrawPacket& packet);

// What packets such a draw's points are.
PointKind point_kind(const PipelineProgram& program);

// Whether lines of such a draw wait with the fragments of small triangles; a line that is cut or takes
// doubles does not.
bool lines_wait(const DrawRecord& draw);

// Whether a draw's lines are binned as runs, set up once for all tiles. Of a few lines it would save little.
bool lines_run(const DrawRecord& draw, Primitive mode, uint32_t count);

// Whether runs are all that such lines' vertices are for, but of lines that are cut or take doubles.
bool lines_run_unshaded(const DrawPlan& draw, const DrawPacket& packet);

}  // namespace halfspace::raster
