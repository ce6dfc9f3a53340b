// Operations on the framebuffer as a whole: clears, the accumulation buffer, copies between colour planes
// (spec 4.2, 4.3).
#pragma once

#include "raster/api/device.h"
#include "tests/oracle/target.h"

namespace halfspace::oracle {

void clear(Target& target, const raster::ClearCommand& command);
void accumulate(Target& target, const raster::AccumCommand& command);
void copy_plane(Target& target, raster::ColorPlane from, raster::ColorPlane to, const raster::Rect& rect);

}  // namespace halfspace::oracle
