#include "state/clip_plane.h"

#include <algorithm>

#include "state/context.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace {

bool is_clip_plane(GLenum plane) {
  return plane >= GL_CLIP_PLANE0 && plane < GL_CLIP_PLANE0 + raster::kMaxClipPlanes;
}

}  // namespace

namespace op {

void clip_plane(Context& context, GLenum plane, const GLdouble* equation) {
  if (!is_clip_plane(plane)) return record_error(context, GL_INVALID_ENUM);
  context.clip_plane.planes[plane - GL_CLIP_PLANE0] = eye_plane(context.transform.modelview.top(), equation);
  mark_dirty(context, kDirtyClipPlanes);
}

void get_clip_plane(Context& context, GLenum plane, GLdouble* equation) {
  if (!is_clip_plane(plane)) return record_error(context, GL_INVALID_ENUM);
  const auto& p = context.clip_plane.planes[plane - GL_CLIP_PLANE0];
  std::copy(p.begin(), p.end(), equation);
}

}  // namespace op
}  // namespace halfspace::state
