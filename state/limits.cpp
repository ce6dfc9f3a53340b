// Queries whose answer no command changes: the implementation's limits, what the visual promised, and the
// initial values of GL 1.1 state that cannot be set yet. A group that comes to life brings its own row, which
// is then taken.
#include <algorithm>

#include "state/context.h"
#include "state/get.h"

namespace halfspace::state {
namespace {

#define FIXED(name, kind, value)                                              \
  {                                                                           \
    name, GetKind::kind, 1, [](const Context&, double* out) { *out = value; } \
  }
#define FIXED_2(name, kind, v0, v1)                           \
  {                                                           \
    name, GetKind::kind, 2, [](const Context&, double* out) { \
      out[0] = v0;                                            \
      out[1] = v1;                                            \
    }                                                         \
  }
#define FIXED_4(name, kind, v0, v1, v2, v3)                   \
  {                                                           \
    name, GetKind::kind, 4, [](const Context&, double* out) { \
      out[0] = v0;                                            \
      out[1] = v1;                                            \
      out[2] = v2;                                            \
      out[3] = v3;                                            \
    }                                                         \
  }
#define VISUAL(name, kind, field)                                                        \
  {                                                                                      \
    name, GetKind::kind, 1, [](const Context& c, double* out) { *out = c.visual.field; } \
  }

constexpr GetRow kRows[] = {
    // limits (spec table 6.25)
    FIXED(GL_SUBPIXEL_BITS, integer, 8),
    FIXED(GL_MAX_TEXTURE_SIZE, integer, raster::kMaxTextureSize),
    FIXED(GL_MAX_LIGHTS, integer, 8),
    FIXED(GL_MAX_CLIP_PLANES, integer, raster::kMaxClipPlanes),
    // the visual
    VISUAL(GL_RED_BITS, integer, red_bits),
    VISUAL(GL_GREEN_BITS, integer, green_bits),
    VISUAL(GL_BLUE_BITS, integer, blue_bits),
    VISUAL(GL_ALPHA_BITS, integer, alpha_bits),
    VISUAL(GL_DEPTH_BITS, integer, depth_bits),
    VISUAL(GL_STENCIL_BITS, integer, stencil_bits),
    VISUAL(GL_ACCUM_RED_BITS, integer, accum_bits),
    VISUAL(GL_ACCUM_GREEN_BITS, integer, accum_bits),
    VISUAL(GL_ACCUM_BLUE_BITS, integer, accum_bits),
    {GL_ACCUM_ALPHA_BITS, GetKind::integer, 1,
     [](const Context& c, double* out) { *out = c.visual.alpha_bits > 0 ? c.visual.accum_bits : 0; }},
    VISUAL(GL_DOUBLEBUFFER, boolean, double_buffered),
    FIXED(GL_INDEX_BITS, integer, 0),
    FIXED(GL_AUX_BUFFERS, integer, 0),
    FIXED(GL_STEREO, boolean, 0),
    FIXED(GL_RGBA_MODE, boolean, 1),
    FIXED(GL_INDEX_MODE, boolean, 0),
};
#undef FIXED
#undef FIXED_2
#undef FIXED_4
#undef VISUAL

}  // namespace

std::span<const GetRow> limits_get_rows() { return kRows; }

}  // namespace halfspace::state
