// glCopyPixels (spec 4.3.3).
#include <algorithm>
#include <vector>

#include "state/context.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"
#include "state/pixel_bands.h"
#include "state/pixel_transfer.h"
#include "state/pixel_value.h"

namespace halfspace::state {
namespace {

using raster::PixelKind;
using raster::PixelPacket;

// Where pixels are copied from. All of them are read before any is drawn, so that the rectangles may overlap.
struct Source {
  Context& context;
  raster::Framebuffer& framebuffer;
  int x, y;           // window position of element (0, 0)
  raster::Rect part;  // elements to copy

  raster::Rect pixels() const { return {part.x0 + x, part.y0 + y, part.x1 + x, part.y1 + y}; }
  size_t width() const { return size_t(part.x1 - part.x0); }
  size_t count() const { return width() * size_t(part.y1 - part.y0); }
  // Of element (x, y) among those that were read.
  size_t index(int ex, int ey) const { return size_t(ey - part.y0) * width() + size_t(ex - part.x0); }
};

void finish_colors(const Context& context, float* rgba, size_t count) {
  if (context.visual.alpha_bits == 0) {
    for (size_t i = 0; i < count; ++i) rgba[4 * i + 3] = 1;
  }
  if (transfers_colors(context)) transfer_colors(context, rgba, count);
  for (size_t i = 0; i < count * 4; ++i) rgba[i] = clamp_unit(rgba[i]);
}

template <class Value, class Read>
void copy_colors(const Source& source, PixelPacket& packet, Read&& read) {
  std::vector<Value> values(source.count() * 4);
  read(source.pixels(), values.data());
  draw_in_bands(source.context, packet, source.part, 4, &PixelPacket::color,
                [&](int x, int y, size_t count, float* out) {
                  const Value* from = &values[source.index(x, y) * 4];
                  for (size_t i = 0; i < count * 4; ++i) out[i] = to_component(from[i]);
                  finish_colors(source.context, out, count);
                });
}

void copy_color(const Source& source, PixelPacket& packet) {
  raster::Device& device = source.context.device;
  const raster::ColorPlane plane = read_plane(source.context);
  if (source.framebuffer.format() == raster::ColorFormat::rgba32f) {
    copy_colors<float>(source, packet, [&](const raster::Rect& rect, float* out) {
      device.read_color_float(rect, out, plane);
    });
  } else {
    copy_colors<uint8_t>(
        source, packet, [&](const raster::Rect& rect, uint8_t* out) { device.read_color(rect, out, plane); });
  }
}

void copy_depth(const Source& source, PixelPacket& packet) {
  std::vector<uint32_t> values(source.count());
  source.context.device.read_depth(source.pixels(), values.data());
  std::vector<double> row(source.width());
  draw_in_bands(source.context, packet, source.part, 1, &PixelPacket::depth,
                [&](int x, int y, size_t count, uint32_t* out) {
                  std::copy_n(&values[source.index(x, y)], count, out);
                  if (!transfers_depths(source.context)) return;
                  for (size_t i = 0; i < count; ++i) row[i] = double(out[i]) / double(kDepthMax);
                  transfer_depths(source.context, row.data(), count);
                  for (size_t i = 0; i < count; ++i) out[i] = uint32_t(row[i] * double(kDepthMax) + 0.5);
                });
}

void copy_stencil(const Source& source, PixelPacket& packet) {
  std::vector<uint8_t> values(source.count());
  source.context.device.read_stencil(source.pixels(), values.data());
  std::vector<int64_t> row(source.width());
  draw_in_bands(source.context, packet, source.part, 1, &PixelPacket::stencil,
                [&](int x, int y, size_t count, uint8_t* out) {
                  std::copy_n(&values[source.index(x, y)], count, row.data());
                  transfer_stencil(source.context, row.data(), count);
                  for (size_t i = 0; i < count; ++i) out[i] = uint8_t(row[i]);
                });
}

// Elements whose pixels exist; the others are undefined (spec 4.3.2), and left out.
raster::Rect existing_part(const raster::Framebuffer& framebuffer, GLint x, GLint y, GLsizei width,
                           GLsizei height) {
  const auto clip = [](int64_t v, int64_t limit) { return int(std::clamp<int64_t>(v, 0, limit)); };
  return {clip(-int64_t{x}, width), clip(-int64_t{y}, height), clip(int64_t{framebuffer.width()} - x, width),
          clip(int64_t{framebuffer.height()} - y, height)};
}

void copy_rectangle(Context& context, GLint x, GLint y, GLsizei width, GLsizei height, PixelKind kind) {
  raster::Framebuffer* framebuffer = read_framebuffer(context);
  if (!framebuffer) return;
  PixelPacket packet = packet_at_raster_position(context);
  packet.kind = kind;
  packet.zoom_x = double(context.pixel_transfer.zoom_x);
  packet.zoom_y = double(context.pixel_transfer.zoom_y);
  const raster::Rect existing = existing_part(*framebuffer, x, y, width, height);
  const Source source{context, *framebuffer, x, y, visible_part(context, packet, existing)};
  if (source.part.empty()) return;
  context.device.begin_pass(framebuffer);
  if (kind == PixelKind::color)
    copy_color(source, packet);
  else if (kind == PixelKind::depth)
    copy_depth(source, packet);
  else
    copy_stencil(source, packet);
}

}  // namespace

namespace op {

void copy_pixels(Context& context, GLint x, GLint y, GLsizei width, GLsizei height, GLenum type) {
  if (type != GL_COLOR && type != GL_DEPTH && type != GL_STENCIL)
    return record_error(context, GL_INVALID_ENUM);
  if (width < 0 || height < 0) return record_error(context, GL_INVALID_VALUE);
  const bool missing = (type == GL_DEPTH && context.visual.depth_bits == 0) ||
                       (type == GL_STENCIL && context.visual.stencil_bits == 0);
  if (missing) return record_error(context, GL_INVALID_OPERATION);
  if (!draws_pixels(context, GL_COPY_PIXEL_TOKEN)) return;
  const PixelKind kind = type == GL_COLOR   ? PixelKind::color
                         : type == GL_DEPTH ? PixelKind::depth
                                            : PixelKind::stencil;
  guard_memory(context, [&] { copy_rectangle(context, x, y, width, height, kind); });
}

}  // namespace op
}  // namespace halfspace::state
