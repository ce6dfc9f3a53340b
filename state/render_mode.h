// Rendering, selection or feedback (spec 5.2, 5.3): glRenderMode, and where primitives go in the latter two.
#pragma once

#include "raster/api/draw_packet.h"
#include "raster/api/feedback.h"
#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

struct RenderModeState {
  GLenum mode = GL_RENDER;
  bool renders() const { return mode == GL_RENDER; }
};

// Whether vertices need texture coordinates though no texture is on: feedback shows them.
bool feedback_needs_tex_coord(const Context& context);

// A draw in selection or feedback mode. May throw std::bad_alloc.
void capture_draw(Context& context, const raster::DrawPacket& packet);

// A raster position has been set, it is valid and has the window depth `z`: it counts as a hit.
void capture_raster_position(Context& context, double z);

// In selection or feedback mode a bitmap or a pixel rectangle would be drawn at the raster position `at`;
// `token` is GL_BITMAP_TOKEN, GL_DRAW_PIXEL_TOKEN or GL_COPY_PIXEL_TOKEN. Nothing is hit by it.
void capture_pixels(Context& context, GLenum token, const raster::FeedbackVertex& at);

}  // namespace halfspace::state
