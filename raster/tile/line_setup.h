// Sets lines of one pixel's width up, once for all tiles they go through.
#pragma once

#include "raster/primitive/line_packet.h"
#include "raster/primitive/segment.h"

namespace halfspace::raster {

// ends: two vertices for each of `count` <= kSetupLanes lines of the draw, none of which is cut.
using SetUpLinesFunction = void (*)(const DrawRecord& draw, const uint32_t* ends, int count, LineGroup& out);
SetUpLinesFunction set_up_lines();

}  // namespace halfspace::raster
