// Pixel rectangles on their way to the device: only the elements that can be seen, some rows at a time, so
// that an image of any size takes little memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "raster/api/pixel_packet.h"
#include "state/raster_position.h"

namespace halfspace::state {

// Elements of an image's `part` (rows from the bottom) that may cover pixels of the drawable: all that do,
// and few more.
raster::Rect visible_part(const Context& context, const raster::PixelPacket& packet,
                          const raster::Rect& part);

// Draws the elements of `part` of an image. `fill(x, y, count, values)` gives those from (x, y) on of row y,
// each of `values_each` numbers; `array` is where the packet takes them.
template <class Value, class Fill>
void draw_in_bands(Context& context, raster::PixelPacket& packet, const raster::Rect& part,
                   size_t values_each, const Value* raster::PixelPacket::*array, Fill&& fill) {
  constexpr int64_t kBandElements = 1 << 15;
  if (part.empty()) return;
  const int width = part.x1 - part.x0;
  const int rows = int(std::clamp<int64_t>(kBandElements / width, 1, part.y1 - part.y0));
  const size_t row_values = size_t(width) * values_each;
  std::vector<Value> values(row_values * size_t(rows));
  packet.width = width;
  packet.first_column = part.x0;
  packet.row_elements = size_t(width);
  packet.*array = values.data();
  for (int y = part.y0; y < part.y1; y += rows) {
    packet.first_row = y;
    packet.height = std::min(rows, part.y1 - y);
    for (int row = 0; row < packet.height; ++row) {
      fill(part.x0, y + row, size_t(width), values.data() + row_values * size_t(row));
    }
    submit_pixels(context, packet);
  }
}

}  // namespace halfspace::state
