// The current raster position (spec 2.13): where pixel rectangles and bitmaps are drawn, and what they bring
// along.
#pragma once

#include "raster/api/pixel_packet.h"
#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

struct RasterPositionState {
  bool valid = true;
  double position[4] = {0, 0, 0, 1};  // window x, y, depth in [0, 1]; clip-space w
  double distance = 0;                // eye distance
  raster::Color color{1, 1, 1, 1};
  float index = 1;  // kept and queried; an RGBA visual draws nothing with it
  double tex_coord[4] = {0, 0, 0, 1};
};

// Whether pixels are to be drawn at the raster position. Not if it is invalid, nor in selection and feedback
// mode; there `token` is reported.
bool draws_pixels(Context& context, GLenum token);

// A packet of no elements yet, at the raster position, with its associated data and the context's state. The
// position is snapped as vertices are, so that what the transform misses a pixel's edge by does not count.
raster::PixelPacket packet_at_raster_position(Context& context);

// Hands a packet to the device. May throw std::bad_alloc.
void submit_pixels(Context& context, const raster::PixelPacket& packet);

}  // namespace halfspace::state
