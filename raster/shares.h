// How a count of things is cut into shares for tasks.
#pragma once

#include <algorithm>
#include <cstdint>

namespace halfspace::raster {

// All shares have `each`, but the last may have less: what is left over would be a task for one thread, which
// the others wait for. None is empty.
struct Shares {
  uint32_t count = 0, each = 0, total = 0;
  uint32_t first(uint32_t share) const { return share * each; }
  uint32_t size(uint32_t share) const { return std::min(each, total - first(share)); }
};

// At most `wanted` shares of `total`, of whole multiples of `multiple`.
inline Shares even_shares(uint32_t total, uint32_t wanted, uint32_t multiple = 1) {
  if (total == 0) return {};
  // Small draws ask for one, and to divide shows there.
  const uint32_t smallest = wanted == 1 ? total : (total - 1) / wanted + 1;
  const uint32_t each = ((smallest - 1) / multiple + 1) * multiple;
  return {each >= total ? 1 : (total - 1) / each + 1, each, total};
}

}  // namespace halfspace::raster
