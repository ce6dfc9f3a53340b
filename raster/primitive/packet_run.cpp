#include "raster/primitive/packet_run.h"

#include "raster/fragment/program.h"

namespace halfspace::raster {

bool points_wait(const DrawRecord& draw) {
  const VertexLayout& layout = draw.vertices.layout;
  return draw.program->packs && layout.tex_coord < 0 && layout.fog < 0 && !draw.shape.smooth_points &&
         draw.shape.point_size == 1 && draw.program->params.accuracy.interpolation != Level::exact;
}

bool points_run(const DrawRecord& draw, Primitive mode) {
  return mode == Primitive::points && !draw.shape.general && points_wait(draw) &&
         !draw.state->raster.flat_shading && draw.vertices.layout.back_color < 0;
}

bool points_run_unshaded(const DrawRecord& draw, const DrawPacket& packet) {
  return draw.runs_points && packet.indices == nullptr && !draw.state->lighting.enabled &&
         draw.state->accuracy.transform != Level::exact;
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

}  // namespace halfspace::raster
