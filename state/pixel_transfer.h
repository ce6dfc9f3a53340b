// Pixel transfer (spec 3.6.5): what is done to pixels on their way between client memory, the framebuffer and
// texture images. Also the rest of the spec's pixel group: the zoom.
#pragma once

#include <cstddef>
#include <cstdint>

#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

struct PixelTransferState {
  bool map_color = false, map_stencil = false;
  GLint index_shift = 0, index_offset = 0;
  float scale[4] = {1, 1, 1, 1}, bias[4] = {0, 0, 0, 0};  // R, G, B, A
  float depth_scale = 1, depth_bias = 0;
  float zoom_x = 1, zoom_y = 1;
};

// Whether transfer changes colours at all; when not, bytes may stay bytes.
bool transfers_colors(const Context& context);

// `count` pixels R, G, B, A, in place: scale and bias, then the maps R_TO_R ... A_TO_A. Not clamped unless
// mapped.
void transfer_colors(const Context& context, float* rgba, size_t count);

// Colour indices through shift, offset and the maps I_TO_R ... I_TO_A; writes R, G, B, A in [0, 1].
void transfer_color_indices(const Context& context, const int64_t* indices, size_t count, float* rgba);

// Stencil indices, in place: shift and offset, then the map S_TO_S.
void transfer_stencil(const Context& context, int64_t* indices, size_t count);

// Depths, where 1 is the far plane, in place: scale, bias, and clamped to [0, 1].
void transfer_depths(const Context& context, double* depths, size_t count);
// Whether that changes a depth in [0, 1].
bool transfers_depths(const Context& context);

}  // namespace halfspace::state
