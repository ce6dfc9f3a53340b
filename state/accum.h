// The accumulation buffer (spec 4.2.4).
#pragma once

#include "raster/api/types.h"

namespace halfspace::state {

struct AccumState {
  raster::Color clear_value;  // in [-1, 1]
};

}  // namespace halfspace::state
