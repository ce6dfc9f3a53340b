// The indices of a part of a draw: which vertices they name.
#pragma once

#include <cstdint>

#include "raster/api/index_ranges.h"

namespace halfspace::raster {

// count > 0.
IndexRange index_range(const uint32_t* indices, uint32_t count);

}  // namespace halfspace::raster
