// glBitmap (spec 3.7).
#include <cmath>

#include "state/context.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"
#include "state/pixel_image.h"
#include "state/raster_position.h"

namespace halfspace::state {
namespace {

constexpr PixelFormat kBits{
    .format = GL_COLOR_INDEX, .type = GL_BITMAP, .components = 1, .element_bytes = 1, .pixel_bytes = 0};

void draw_bitmap(Context& context, GLsizei width, GLsizei height, double x_origin, double y_origin,
                 const GLvoid* bits) {
  const std::vector<std::byte> image = unpack_image(kBits, context.pixel_store.unpack, width, height, bits);
  if (image.empty()) return;
  raster::PixelPacket packet = packet_at_raster_position(context);
  packet.kind = raster::PixelKind::bitmap;
  packet.x = std::floor(packet.x - x_origin);
  packet.y = std::floor(packet.y - y_origin);
  packet.width = width;
  packet.height = height;
  packet.bits = reinterpret_cast<const uint8_t*>(image.data());
  packet.row_bytes = image_layout(kBits, kPackedStore, width).row_bytes;
  submit_pixels(context, packet);
}

}  // namespace

namespace op {

void bitmap(Context& context, GLsizei width, GLsizei height, GLfloat x_origin, GLfloat y_origin,
            GLfloat x_move, GLfloat y_move, const GLvoid* bits) {
  if (width < 0 || height < 0) return record_error(context, GL_INVALID_VALUE);
  if (!context.raster_position.valid) return;  // it does not move either
  guard_memory(context, [&] {
    if (draws_pixels(context, GL_BITMAP_TOKEN))
      draw_bitmap(context, width, height, double(x_origin), double(y_origin), bits);
    context.raster_position.position[0] += double(x_move);
    context.raster_position.position[1] += double(y_move);
  });
}

}  // namespace op
}  // namespace halfspace::state
