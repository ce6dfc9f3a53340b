#include "state/viewport.h"

#include <algorithm>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace op {

void viewport(Context& context, GLint x, GLint y, GLsizei width, GLsizei height) {
  if (width < 0 || height < 0) return record_error(context, GL_INVALID_VALUE);
  ViewportState& v = context.viewport;
  v.x = x;
  v.y = y;
  v.width = std::min(width, raster::kMaxSurfaceSize);  // silently, as spec 2.10.1 asks
  v.height = std::min(height, raster::kMaxSurfaceSize);
  mark_dirty(context, kDirtyViewport);
}

void depth_range(Context& context, GLdouble z_near, GLdouble z_far) {
  const auto clamp = [](double z) { return z > 0 ? std::min(z, 1.0) : 0.0; };  // NaN becomes 0
  context.viewport.depth_near = clamp(z_near);
  context.viewport.depth_far = clamp(z_far);
  mark_dirty(context, kDirtyViewport);
}

}  // namespace op

std::span<const GetRow> viewport_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_VIEWPORT, GetKind::integer, 4,
       [](const Context& c, double* out) {
         out[0] = c.viewport.x;
         out[1] = c.viewport.y;
         out[2] = c.viewport.width;
         out[3] = c.viewport.height;
       }},
      {GL_DEPTH_RANGE, GetKind::normalized, 2,
       [](const Context& c, double* out) {
         out[0] = c.viewport.depth_near;
         out[1] = c.viewport.depth_far;
       }},
      {GL_MAX_VIEWPORT_DIMS, GetKind::integer, 2,
       [](const Context&, double* out) { out[0] = out[1] = raster::kMaxSurfaceSize; }},
  };
  return kRows;
}

}  // namespace halfspace::state
