// Where in its framebuffer a draw can have fragments.
#pragma once

#include "raster/api/draw_state.h"
#include "raster/surface/framebuffer.h"

namespace halfspace::raster {

inline Rect draw_window(const DrawState& state, const Framebuffer::Impl& fb) {
  const Rect whole{0, 0, fb.width, fb.height};
  return state.raster.scissor_test ? intersect(whole, state.raster.scissor) : whole;
}

// What is cut by the viewport's planes, too: all but wide points and lines.
inline Rect draw_bounds(const DrawState& state, const Framebuffer::Impl& fb) {
  const Viewport& v = state.viewport;
  return intersect(draw_window(state, fb), {v.x, v.y, v.x + v.width, v.y + v.height});
}

}  // namespace halfspace::raster
