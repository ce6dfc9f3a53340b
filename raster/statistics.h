// The counts of a picture as a table on stderr.
#pragma once

#include "raster/api/device.h"

namespace halfspace::raster {

// HALFSPACE_STATS: 1 prints the counts of each picture that is shown, draws those of each draw, too.
enum class Report : uint8_t { nothing, pictures, draws };
Report report_from_environment();

// What was counted between `before` and `now`: vertices, triangles and fragments, then each stage that ran
// with its fragments and its time. A stage that is not called for is not there.
// `pixels`: of the picture, or 0 for a single draw.
void print_statistics(const DeviceStatistics& before, const DeviceStatistics& now, size_t pixels);

}  // namespace halfspace::raster
