// Compiled once an ISA level: what every x86-64 has knows no minimum of unsigned words.
#include "raster/primitive/index_part.h"

#include <algorithm>

#include "raster/isa.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/primitive/index_part.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace halfspace::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::ScalableTag<uint32_t>;

IndexRange FindRange(const uint32_t* indices, uint32_t count) {
  const Words d;
  const auto lanes = static_cast<uint32_t>(hn::Lanes(d));
  uint32_t lowest = indices[0], highest = indices[0], i = 0;
  if (count >= lanes) {
    auto low = hn::LoadU(d, indices), high = low;
    for (; i + lanes <= count; i += lanes) {
      const auto v = hn::LoadU(d, indices + i);
      low = hn::Min(low, v);
      high = hn::Max(high, v);
    }
    lowest = hn::GetLane(hn::MinOfLanes(d, low));
    highest = hn::GetLane(hn::MaxOfLanes(d, high));
  }
  for (; i < count; ++i) {
    lowest = indices[i] < lowest ? indices[i] : lowest;
    highest = indices[i] > highest ? indices[i] : highest;
  }
  return {lowest, highest};
}

}  // namespace HWY_NAMESPACE
}  // namespace halfspace::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace halfspace::raster {
namespace {
using RangeFunction = IndexRange (*)(const uint32_t*, uint32_t);
RangeFunction select_range() { HALFSPACE_SELECT_FUNCTION(FindRange) }
}  // namespace

void find_index_ranges(const uint32_t* indices, size_t count, IndexRange* ranges) {
  const RangeFunction find = select_range();
  for (size_t first = 0; first < count; first += kIndexStretch)
    *ranges++ = find(indices + first, uint32_t(std::min<size_t>(count - first, kIndexStretch)));
}

IndexRange index_range(const uint32_t* indices, uint32_t count) { return select_range()(indices, count); }
}  // namespace halfspace::raster
#endif
