#include "tests/oracle/pixels.h"

#include <algorithm>

namespace halfspace::oracle {
namespace {

// Element i covers the centres between origin + zoom * i and origin + zoom * (i + 1), the lower of the two
// included. The element of a pixel; none: the image does not reach it.
std::optional<int> element_at(int pixel, double origin, double zoom, int first, int count) {
  const double center = pixel + 0.5;
  const auto edge = [&](int i) { return origin + zoom * i; };
  const auto holds = [&](int i) {
    return zoom > 0 ? edge(i) <= center && center < edge(i + 1) : edge(i + 1) <= center && center < edge(i);
  };
  if (!(zoom < 0 || zoom > 0)) return std::nullopt;
  const double guess = std::floor((center - origin) / zoom);
  if (!(guess >= first - 2.0 && guess <= first + count + 2.0)) return std::nullopt;
  for (int i = static_cast<int>(guess) - 1; i <= static_cast<int>(guess) + 1; ++i)
    if (holds(i) && i >= first && i < first + count) return i - first;
  return std::nullopt;
}

// All fragments share what the raster position had.
Surface shared_surface(const raster::PixelPacket& packet) {
  Corner corner;
  const raster::Color& c = packet.raster_color;
  const float color[4] = {c.r, c.g, c.b, c.a};
  for (size_t k = 0; k < 4; ++k) {
    corner.value[kRed + k] = held(wide(color[k]), wide(0), wide(1));
    corner.value[kCoordS + k] = wide(packet.raster_tex_coord[k]);
  }
  corner.value[kFogDistance] = wide(packet.raster_distance);
  Surface surface = Surface::of_point(corner, {});
  surface.set_depth(real(packet.raster_depth) * kDepthSteps);
  return surface;
}

bool bit_at(const raster::PixelPacket& packet, size_t column, size_t row) {
  return (packet.bits[row * packet.row_bytes + column / 8] >> (7 - column % 8) & 1) != 0;
}

}  // namespace

void draw_pixels(const raster::PixelPacket& packet, Target& target, Painter& painter) {
  const Surface surface = shared_surface(packet);
  const raster::Rect window = painter.window();
  for (int y = window.y0; y < window.y1; ++y) {
    const auto j = element_at(y, packet.y, packet.zoom_y, packet.first_row, packet.height);
    if (!j) continue;
    for (int x = window.x0; x < window.x1; ++x) {
      const auto i = element_at(x, packet.x, packet.zoom_x, packet.first_column, packet.width);
      if (!i) continue;
      const auto column = static_cast<size_t>(*i), row = static_cast<size_t>(*j);
      const size_t element = row * packet.row_elements + column;
      switch (packet.kind) {
        case raster::PixelKind::color:
          painter.paint(x, y, surface, 1, {packet.color + 4 * element, nullptr});
          break;
        case raster::PixelKind::depth:
          painter.paint(x, y, surface, 1, {nullptr, packet.depth + element});
          break;
        case raster::PixelKind::bitmap:
          if (bit_at(packet, column, row)) painter.paint(x, y, surface);
          break;
        case raster::PixelKind::stencil: {
          // Under the mask, past all operations but ownership and scissor.
          uint8_t& stored = target.stencil[target.at(x, y)];
          stored = static_cast<uint8_t>((packet.stencil[element] & packet.stencil_mask) |
                                        (stored & ~packet.stencil_mask));
        }
      }
    }
  }
}

}  // namespace halfspace::oracle
