// Points of one pixel that take a short way to memory.
#pragma once

#include "raster/primitive/segment.h"

namespace halfspace::raster {

// Whether a point's colour is all that its fragment is made from: it then waits with the fragments of small
// triangles, without any set-up. At standard accuracy the colour is the same float whether a plane in float
// or one in double gives it.
bool points_wait(const DrawRecord& draw);

// Whether such a draw's points, each of its own colour, are binned as runs.
bool points_run(const DrawRecord& draw, Primitive mode);

// Whether nothing but runs is made from their vertices, each of which is named once.
bool points_run_unshaded(const DrawRecord& draw, const DrawPacket& packet);

}  // namespace halfspace::raster
