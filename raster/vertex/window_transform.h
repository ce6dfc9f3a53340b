// Clip coordinates to snapped window coordinates, one vertex at a time: what the kernels do, for the clipper.
#pragma once

#include <cstdint>

#include "raster/api/draw_state.h"
#include "raster/vertex/vertex_kernels.h"

namespace halfspace::raster {

WindowTransform make_window_transform(const Viewport& viewport);

// 16.8 coordinate of clip / w along one axis. w >= kMinW; the result is held to the guard band, which a
// coordinate that was cut there may miss by its rounding.
int32_t snap_coordinate(double clip, double w, double scale, double offset);

}  // namespace halfspace::raster
