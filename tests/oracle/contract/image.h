// The picture in the layout somebody wants to see it in.
#pragma once

#include "raster/api/framebuffer.h"
#include "tests/oracle/target.h"

namespace halfspace::oracle {

void store_image(const Target& target, raster::ColorPlane plane, const raster::LinearImage& image);

}  // namespace halfspace::oracle
