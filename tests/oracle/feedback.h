// Primitives as feedback and selection see them (spec 5.2, 5.3): cut at the clip volume itself, never
// snapped.
#pragma once

#include "raster/api/draw_packet.h"
#include "raster/api/feedback.h"

namespace halfspace::oracle {

void feed_back(const raster::DrawPacket& packet, raster::FeedbackSink& sink);

}  // namespace halfspace::oracle
