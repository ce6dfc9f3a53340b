// The indices of a part of a draw: which vertices they name, and the same counted from the lowest of those.
#pragma once

#include <cstdint>

namespace halfspace::raster {

struct IndexRange {
  uint32_t lowest, highest;
};

// count > 0.
IndexRange index_range(const uint32_t* indices, uint32_t count);

// out[i] = indices[i] - base.
void rebase_indices(const uint32_t* indices, uint32_t count, uint32_t base, uint32_t* out);

}  // namespace halfspace::raster
