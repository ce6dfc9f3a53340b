// A frame's truth on disk, one file a frame that is shown and has something new: DIR/frame_NNNNN.truth. One
// line "halfspace-truth 1 WIDTH HEIGHT\n", then a record a pixel, bottom row first, little endian:
//   float32 r, g, b, a   levels 0 .. 255 after the last write, before rounding to bytes
//   uint32  owner        number, from 1, of the frame's primitive that wrote the pixel last; 0: the
//   background uint32  draw         the same of its draw float64 depth        0 .. 2^24 - 1, unrounded
// and, beside it, frame_NNNNN.bounds with a line "halfspace-bounds 1 WIDTH HEIGHT\n" and for each pixel 9
// bytes: the lowest r, g, b, a that may be stored, the highest, and 1 where some test was too close to call.
#pragma once

#include <string>

#include "raster/api/types.h"
#include "tests/oracle/target.h"

namespace halfspace::oracle {

// False: it could not be written.
bool write_truth(const Target& target, raster::ColorPlane plane, const std::string& directory,
                 unsigned frame);

}  // namespace halfspace::oracle
