// glClear (spec 4.2.3).
#include "state/context.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"

namespace halfspace::state {
namespace {

constexpr GLbitfield kClearable =
    GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT | GL_ACCUM_BUFFER_BIT;

// Bits of buffers that the visual lacks have no effect.
raster::ClearCommand clear_command(const Context& context, GLbitfield mask) {
  const ColorBufferState& color = context.color_buffer;
  const DepthBufferState& depth = context.depth_buffer;
  const StencilBufferState& stencil = context.stencil_buffer;
  raster::ClearCommand command;
  command.color_targets = draw_planes(context);
  command.color = (mask & GL_COLOR_BUFFER_BIT) != 0 && !color.mask.none() && command.color_targets != 0;
  command.color_value = color.clear_color;
  command.color_mask = color.mask;
  if (context.visual.alpha_bits == 0) command.color_value.a = 1;  // such a buffer reads alpha 1
  command.depth = (mask & GL_DEPTH_BUFFER_BIT) != 0 && depth.write && context.visual.depth_bits > 0;
  command.depth_value = depth.clear_value;
  command.depth_write = depth.write;
  command.stencil =
      (mask & GL_STENCIL_BUFFER_BIT) != 0 && context.visual.stencil_bits > 0 && uint8_t(stencil.write_mask) != 0;
  command.stencil_value = uint8_t(stencil.clear_value);
  command.stencil_mask = uint8_t(stencil.write_mask);
  command.accum = (mask & GL_ACCUM_BUFFER_BIT) != 0 && context.visual.accum_bits > 0;
  command.accum_value = context.accum.clear_value;
  command.scissor_test = context.scissor.test;
  command.scissor = context.scissor.rect();
  return command;
}

}  // namespace

namespace op {

void clear(Context& context, GLbitfield mask) {
  if ((mask & ~kClearable) != 0) return record_error(context, GL_INVALID_VALUE);
  const raster::ClearCommand command = clear_command(context, mask);
  if (!context.render_mode.renders()) return;  // as no other pixels are written (spec 5.2, 5.3)
  if (!command.color && !command.depth && !command.stencil && !command.accum) return;
  guard_memory(context, [&] {
    raster::Framebuffer* framebuffer = draw_framebuffer(context);
    if (!framebuffer) return;
    context.device.begin_pass(framebuffer);
    context.device.clear(command);
  });
}

}  // namespace op
}  // namespace halfspace::state
