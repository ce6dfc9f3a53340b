#include "raster/tile/settled_planes.h"

#include <algorithm>

#include "raster/tile/setup_batch.h"

namespace halfspace::raster {

void settle_pieces(const DrawRecord& draw, PrimitiveKind kind, uint32_t first, const PlaneSource* sources,
                   Segment& segment) {
  const SettlePlanesFunction settle = settle_planes();
  const auto end = static_cast<uint32_t>(segment.cut_triangles.size());
  const auto settled = static_cast<uint32_t>(segment.plane_sources.size());
  segment.plane_sources.resize(settled + end - first);
  for (uint32_t at = first; at < end; at += kSetupLanes) {
    CutTriangle* const pieces = segment.cut_triangles.data() + at;
    const uint32_t count = std::min(uint32_t{kSetupLanes}, end - at);
    const PlaneSource* of[kSetupLanes];
    for (uint32_t i = 0; i < count; ++i) of[i] = &sources[pieces[i].source];
    const uint32_t to = settled + at - first;
    settle(draw, kind, pieces, of, static_cast<int>(count), segment.plane_sources.data() + to);
    for (uint32_t i = 0; i < count; ++i) pieces[i].source = to + i;
  }
}

}  // namespace halfspace::raster
