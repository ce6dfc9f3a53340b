// Pixel rectangles and bitmaps (spec 3.6.4, "Rasterization", and 3.7).
#pragma once

#include "raster/api/pixel_packet.h"
#include "tests/oracle/painter.h"

namespace halfspace::oracle {

void draw_pixels(const raster::PixelPacket& packet, Target& target, Painter& painter);

}  // namespace halfspace::oracle
