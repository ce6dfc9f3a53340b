// glDrawPixels (spec 3.6.4).
#include "state/context.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"
#include "state/pixel_bands.h"
#include "state/pixel_image.h"

namespace halfspace::state {
namespace {

using raster::PixelKind;
using raster::PixelPacket;

PixelKind kind_of(GLenum format) {
  switch (format) {
    case GL_DEPTH_COMPONENT:
      return PixelKind::depth;
    case GL_STENCIL_INDEX:
      return PixelKind::stencil;
    default:
      return PixelKind::color;
  }
}

void draw_image(Context& context, GLsizei width, GLsizei height, GLenum format, ImageReader& reader) {
  PixelPacket packet = packet_at_raster_position(context);
  packet.kind = kind_of(format);
  packet.zoom_x = double(context.pixel_transfer.zoom_x);
  packet.zoom_y = double(context.pixel_transfer.zoom_y);
  const raster::Rect part = visible_part(context, packet, {0, 0, width, height});
  switch (packet.kind) {
    case PixelKind::depth:
      return draw_in_bands(
          context, packet, part, 1, &PixelPacket::depth,
          [&](int x, int y, size_t count, uint32_t* out) { reader.read_depth(x, y, count, out); });
    case PixelKind::stencil:
      return draw_in_bands(
          context, packet, part, 1, &PixelPacket::stencil,
          [&](int x, int y, size_t count, uint8_t* out) { reader.read_stencil(x, y, count, out); });
    default:
      return draw_in_bands(
          context, packet, part, 4, &PixelPacket::color,
          [&](int x, int y, size_t count, float* out) { reader.read_rgba(x, y, count, out); });
  }
}

}  // namespace

namespace op {

void draw_pixels(Context& context, GLsizei width, GLsizei height, GLenum format, GLenum type,
                 const GLvoid* pixels) {
  if (width < 0 || height < 0) return record_error(context, GL_INVALID_VALUE);
  PixelFormat described;
  const GLenum error = describe_pixels(format, type, described);
  if (error != GL_NO_ERROR) return record_error(context, error);
  if (format == GL_STENCIL_INDEX && context.visual.stencil_bits == 0) {
    return record_error(context, GL_INVALID_OPERATION);
  }
  if (!draws_pixels(context, GL_DRAW_PIXEL_TOKEN) || pixels == nullptr) return;
  guard_memory(context, [&] {
    ImageReader reader(context, described, context.pixel_store.unpack, width, pixels);
    draw_image(context, width, height, format, reader);
  });
}

}  // namespace op
}  // namespace halfspace::state
