// Which vertices a draw's indices name, stretch by stretch: who looks through them once for the whole draw
// spares the device a look at each part of it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace halfspace::raster {

struct IndexRange {
  uint32_t lowest, highest;
};

inline constexpr uint32_t kIndexStretch = 4096;
constexpr size_t index_stretches(size_t count) { return (count + kIndexStretch - 1) / kIndexStretch; }

// Of each stretch of `count` indices, the last of which may be shorter: `ranges` has index_stretches(count).
void find_index_ranges(const uint32_t* indices, size_t count, IndexRange* ranges);

// The range of all of them. count > 0.
inline IndexRange joined_range(const IndexRange* ranges, size_t count) {
  IndexRange all = ranges[0];
  for (size_t i = 1; i < count; ++i) {
    if (ranges[i].lowest < all.lowest) all.lowest = ranges[i].lowest;
    if (ranges[i].highest > all.highest) all.highest = ranges[i].highest;
  }
  return all;
}

}  // namespace halfspace::raster
