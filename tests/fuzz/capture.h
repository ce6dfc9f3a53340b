// Whether what selection and feedback brought is what another renderer brought.
#pragma once

#include <string>

#include "renderer.h"

namespace halfspace::fuzz {

// What differs, or "". Hits have to be the same, with depths to 2^-12 of the range. Of feedback, points,
// lines, bitmaps and markers have to be the same to 1/32 pixel and 1/64 of all else; how a polygon is cut
// into polygons is the renderer's affair (spec 5.3), so of neighbouring polygons the area, its moments and
// their corners are compared.
std::string compare(const Capture& ours, const Capture& theirs);

}  // namespace halfspace::fuzz
