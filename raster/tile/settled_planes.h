// Planes of what was cut, in the form set-up gives planes: once a piece, where it is cut, eight pieces at a
// time. Tiles take them as they are.
#pragma once

#include "raster/primitive/segment.h"

namespace halfspace::raster {

// `count` <= kSetupLanes pieces of one kind, each with the planes of the primitive it was cut from.
using SettlePlanesFunction = void (*)(const DrawRecord& draw, PrimitiveKind kind, const CutTriangle* pieces,
                                      const PlaneSource* const* sources, int count, PlaneSource* out);
SettlePlanesFunction settle_planes();

// Settles the planes of the segment's cut_triangles from `first` on, whose `source` is an index into
// `sources` before, and of the segment's plane_sources after.
void settle_pieces(const DrawRecord& draw, PrimitiveKind kind, uint32_t first, const PlaneSource* sources,
                   Segment& segment);

}  // namespace halfspace::raster
