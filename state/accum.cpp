#include "state/accum.h"

#include <algorithm>
#include <optional>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"

namespace halfspace::state {
namespace {

using raster::AccumOp;

std::optional<AccumOp> accum_op_of(GLenum op) {
  switch (op) {
    case GL_ACCUM:
      return AccumOp::accum;
    case GL_LOAD:
      return AccumOp::load;
    case GL_RETURN:
      return AccumOp::return_;
    case GL_MULT:
      return AccumOp::mult;
    case GL_ADD:
      return AccumOp::add;
    default:
      return std::nullopt;
  }
}

float clamp_signed(float v) { return v > -1 ? std::min(v, 1.0f) : -1.0f; }

}  // namespace

namespace op {

// Reading from another drawable than the one drawn to is refused: the accumulation buffer is the latter's.
void accum(Context& context, GLenum op, GLfloat value) {
  const std::optional<AccumOp> known = accum_op_of(op);
  if (!known) return record_error(context, GL_INVALID_ENUM);
  const bool reads_elsewhere = context.read_drawable && context.read_drawable != context.drawable;
  if (context.visual.accum_bits == 0 || reads_elsewhere) return record_error(context, GL_INVALID_OPERATION);
  if (!context.render_mode.renders()) return;  // as no other pixels are written (spec 5.2, 5.3)
  raster::AccumCommand command;
  command.op = *known;
  command.value = value;
  command.read_plane = read_plane(context);
  command.color_targets = draw_planes(context);
  command.color_mask = context.color_buffer.mask;
  command.scissor_test = context.scissor.test;
  command.scissor = context.scissor.rect();
  guard_memory(context, [&] {
    flush_vertices(context);
    if (!context.drawable) return;
    context.device.begin_pass(&context.drawable->framebuffer(command.color_targets | command.read_plane));
    context.device.accumulate(command);
  });
}

void clear_accum(Context& context, GLfloat r, GLfloat g, GLfloat b, GLfloat a) {
  context.accum.clear_value = {clamp_signed(r), clamp_signed(g), clamp_signed(b), clamp_signed(a)};
}

}  // namespace op

std::span<const GetRow> accum_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_ACCUM_CLEAR_VALUE, GetKind::normalized, 4,
       [](const Context& c, double* out) {
         const raster::Color& color = c.accum.clear_value;
         out[0] = double(color.r);
         out[1] = double(color.g);
         out[2] = double(color.b);
         out[3] = double(color.a);
       }},
  };
  return kRows;
}

}  // namespace halfspace::state
