// HALFSPACE_CAPTURE=DIRECTORY: every frame a program shows is also written to DIRECTORY/frame_00000.ppm and
// so on.
#pragma once

#include <cstdint>

namespace halfspace::gl {

// Whether HALFSPACE_CAPTURE names a directory; without it a front end need not read the picture back.
bool capture_enabled();

// Writes the next frame of this process as a binary PPM; alpha is left out. `rgba`: width x height pixels of
// four bytes, the lowest row first, as Device::read_color gives them. A failure is reported once on stderr.
// Any thread may call.
void capture_frame(const uint8_t* rgba, int width, int height);

}  // namespace halfspace::gl
