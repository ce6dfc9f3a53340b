// The counts of a picture as a table on stderr.
#pragma once

#include "raster/api/device.h"

namespace halfspace::raster {

// What was counted between `before` and `now`: vertices, triangles and fragments, then each stage that ran
// with its fragments and its time. A stage that is not called for is not there.
void print_statistics(const DeviceStatistics& before, const DeviceStatistics& now);

}  // namespace halfspace::raster
