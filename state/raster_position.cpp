#include "state/raster_position.h"

#include <algorithm>
#include <cmath>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"
#include "state/pixel_value.h"

namespace halfspace::state {
namespace {

raster::VertexBatch batch_of_one(const CurrentState& current, const float position[4]) {
  raster::VertexBatch batch;
  batch.position = {position, 0, 4};
  batch.color = {current.color, 0, 4};
  batch.tex_coord = {current.tex_coord, 0, 4};
  batch.normal = {current.normal, 0, 3};
  batch.count = 1;
  return batch;
}

// To 1/256 pixel, halves up.
double snapped(double v) { return std::floor(v * 256 + 0.5) / 256; }

}  // namespace

bool draws_pixels(Context& context, GLenum token) {
  const RasterPositionState& at = context.raster_position;
  if (!at.valid || context.render_mode.renders()) return at.valid;
  const auto& p = at.position;
  const auto& t = at.tex_coord;
  capture_pixels(context, token, {p[0], p[1], p[2], p[3], at.color, t[0], t[1], t[2], t[3]});
  return false;
}

raster::PixelPacket packet_at_raster_position(Context& context) {
  const RasterPositionState& from = context.raster_position;
  raster::PixelPacket packet;
  packet.state = derive(context);
  packet.stencil_mask = packet.state->stencil.write_mask;
  packet.x = snapped(from.position[0]);
  packet.y = snapped(from.position[1]);
  packet.stencil_mask = uint8_t(context.stencil_buffer.write_mask);
  packet.raster_color = from.color;
  packet.raster_depth = from.position[2];
  packet.raster_distance = from.distance;
  std::copy_n(from.tex_coord, 4, packet.raster_tex_coord);
  return packet;
}

void submit_pixels(Context& context, const raster::PixelPacket& packet) {
  if (!context.drawable) return;
  flush_vertices(context);  // what waits was drawn before
  context.device.begin_pass(&context.drawable->framebuffer(packet.state->color_targets));
  context.device.draw_pixels(packet);
}

namespace op {

void raster_pos(Context& context, GLfloat x, GLfloat y, GLfloat z, GLfloat w) {
  guard_memory(context, [&] {
    const float position[4] = {x, y, z, w};
    const raster::ShadedPoint point =
        context.device.shade_point(*derive(context), batch_of_one(context.current, position));
    RasterPositionState& to = context.raster_position;
    to.valid = point.valid;
    if (!point.valid) return;  // the rest is undefined then
    to.position[0] = point.x;
    to.position[1] = point.y;
    to.position[2] = point.z;
    to.position[3] = point.w;
    to.distance = point.eye_distance;
    to.color = point.color;
    to.index = context.current.index;
    std::copy_n(point.tex_coord, 4, to.tex_coord);
    capture_raster_position(context, point.z);
  });
}

// GL_ARB_window_pos: window coordinates as they are, no transform, no lighting, always valid (OpenGL 1.4, 2.13).
void window_pos(Context& context, GLfloat x, GLfloat y, GLfloat z) {
  flush_vertices(context);
  const ViewportState& viewport = context.viewport;
  const CurrentState& current = context.current;
  RasterPositionState& to = context.raster_position;
  const double depth = double(clamp_unit(z));
  to.valid = true;
  to.position[0] = double(x);
  to.position[1] = double(y);
  to.position[2] = viewport.depth_near + depth * (viewport.depth_far - viewport.depth_near);
  to.position[3] = 1;
  to.distance = 0;
  to.color = {clamp_unit(current.color[0]), clamp_unit(current.color[1]), clamp_unit(current.color[2]),
              clamp_unit(current.color[3])};
  to.index = current.index;
  std::copy_n(current.tex_coord, 4, to.tex_coord);
  capture_raster_position(context, to.position[2]);
}

}  // namespace op

std::span<const GetRow> raster_position_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_CURRENT_RASTER_POSITION_VALID, GetKind::boolean, 1,
       [](const Context& c, double* out) { *out = c.raster_position.valid; }},
      {GL_CURRENT_RASTER_POSITION, GetKind::real, 4,
       [](const Context& c, double* out) { std::copy_n(c.raster_position.position, 4, out); }},
      {GL_CURRENT_RASTER_DISTANCE, GetKind::real, 1,
       [](const Context& c, double* out) { *out = c.raster_position.distance; }},
      {GL_CURRENT_RASTER_COLOR, GetKind::normalized, 4,
       [](const Context& c, double* out) {
         const raster::Color& color = c.raster_position.color;
         out[0] = double(color.r);
         out[1] = double(color.g);
         out[2] = double(color.b);
         out[3] = double(color.a);
       }},
      {GL_CURRENT_RASTER_INDEX, GetKind::real, 1,
       [](const Context& c, double* out) { *out = double(c.raster_position.index); }},
      {GL_CURRENT_RASTER_TEXTURE_COORDS, GetKind::real, 4,
       [](const Context& c, double* out) { std::copy_n(c.raster_position.tex_coord, 4, out); }},
  };
  return kRows;
}

}  // namespace halfspace::state
