// The vertex stage for one vertex that is no primitive's: the raster position (spec 2.13).
#pragma once

#include "raster/api/device.h"

namespace halfspace::raster {

ShadedPoint shade_point(const DrawState& state, const VertexBatch& batch);

}  // namespace halfspace::raster
