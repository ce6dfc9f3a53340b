// What a device is made with: its options, and what the environment says where they leave it open.
#pragma once

#include "raster/api/device.h"

namespace halfspace::raster {

// The options', HALFSPACE_THREADS, or a thread for each core.
int thread_count(const DeviceOptions& options);
// Whether stages may run together: not if the options or HALFSPACE_FUSE=0 say so.
bool fuses(const DeviceOptions& options);

}  // namespace halfspace::raster
