#include "raster/primitive/packet_run.h"

#include "raster/fragment/program.h"

namespace halfspace::raster {

bool points_wait(const VertexLayout& layout, const ShapePlan& shape, const PipelineProgram& program) {
  return program.packs && layout.tex_coord < 0 && layout.fog < 0 && !shape.smooth_points &&
         shape.point_size == 1 && program.params.accuracy.interpolation != Level::exact;
}

bool points_run(const DrawPlan& draw, Primitive mode) {
  return mode == Primitive::points && !draw.shape.general &&
         points_wait(draw.layout, draw.shape, draw.program) && !draw.state.raster.flat_shading &&
         draw.layout.back_color < 0;
}

bool points_run_unshaded(const DrawPlan& draw, const DrawPacket& packet) {
  return points_run(draw, packet.primitive) && packet.indices == nullptr && !draw.state.lighting.enabled &&
         draw.state.accuracy.transform != Level::exact;
}

PointKind point_kind(const PipelineProgram& program) {
  if (!program.stores_color) return PointKind::colored;
  return program.reads_depth ? PointKind::tested_pixel : PointKind::pixel;
}

bool lines_wait(const DrawRecord& draw) {
  const VertexLayout& layout = draw.vertices.layout;
  return draw.program->packs && draw.shape.plain_lines() && layout.back_color < 0 && layout.low < 0 &&
         !layout.projective && !draw.program->params.one_lambda;
}

bool lines_run(const DrawRecord& draw, Primitive mode, uint32_t count) {
  constexpr uint32_t kFew = 8;
  const bool lines =
      mode == Primitive::lines || mode == Primitive::line_strip || mode == Primitive::line_loop;
  return lines && count >= kFew && !draw.shape.general && lines_wait(draw);
}

bool lines_run_unshaded(const DrawPlan& draw, const DrawPacket& packet) {
  return packet.primitive == Primitive::lines && packet.indices == nullptr && !draw.state.lighting.enabled &&
         draw.state.accuracy.transform != Level::exact && draw.layout.tex_coord < 0 && draw.layout.fog < 0;
}

}  // namespace halfspace::raster
