// Which vertices of a draw make which primitives (spec 2.6.1).
#pragma once

#include <cstdint>
#include <vector>

#include "raster/api/types.h"

namespace halfspace::oracle {

struct GivenPrimitive {
  std::vector<uint32_t> places;  // in the draw's list of vertices: one, two, or a polygon's corners in order
  // Of polygons and lines: which of `places` gives the flat colour (spec table 2.12: the last vertex of a
  // primitive, but a polygon's first).
  uint32_t provoking = 0;
  bool flagged = false;   // edge flags count: polygons that stand alone (spec 2.6.2)
  bool restarts = false;  // of lines: the stipple starts anew (spec 3.4.2.2)
};

// All primitives of `count` vertices, in order.
std::vector<GivenPrimitive> primitives_of(raster::Primitive mode, uint32_t count);

}  // namespace halfspace::oracle
