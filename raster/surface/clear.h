// Clears (spec 4.2.3): marks where whole blocks are cleared, pixels where a scissor or a mask cuts them.
#pragma once

#include "raster/api/device.h"
#include "raster/surface/framebuffer.h"

namespace halfspace::raster {

// True if the command sets every pixel of the buffers it names, so that what was there before does not matter.
bool clears_everything(const Framebuffer::Impl& framebuffer, const ClearCommand& command);

// Nothing may be pending for the framebuffer. Throws std::bad_alloc before anything is changed.
void clear(Framebuffer::Impl& framebuffer, const ClearCommand& command);

}  // namespace halfspace::raster
