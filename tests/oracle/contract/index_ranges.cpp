#include "raster/api/index_ranges.h"

#include <algorithm>

namespace halfspace::raster {

void find_index_ranges(const uint32_t* indices, size_t count, IndexRange* ranges) {
  for (size_t first = 0; first < count; first += kIndexStretch) {
    const auto [low, high] = std::minmax_element(indices + first, indices + std::min(count, first + kIndexStretch));
    *ranges++ = {*low, *high};
  }
}

}  // namespace halfspace::raster
