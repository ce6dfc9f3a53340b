#include "state/hint.h"

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace {

GLenum* hint_of(HintState& hint, GLenum target) {
  switch (target) {
    case GL_PERSPECTIVE_CORRECTION_HINT:
      return &hint.perspective_correction;
    case GL_POINT_SMOOTH_HINT:
      return &hint.point_smooth;
    case GL_LINE_SMOOTH_HINT:
      return &hint.line_smooth;
    case GL_POLYGON_SMOOTH_HINT:
      return &hint.polygon_smooth;
    case GL_FOG_HINT:
      return &hint.fog;
    default:
      return nullptr;
  }
}

}  // namespace

namespace op {

void hint(Context& context, GLenum target, GLenum mode) {
  GLenum* value = hint_of(context.hint, target);
  const bool known = mode == GL_FASTEST || mode == GL_NICEST || mode == GL_DONT_CARE;
  if (!value || !known) return record_error(context, GL_INVALID_ENUM);
  *value = mode;
}

}  // namespace op

std::span<const GetRow> hint_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_PERSPECTIVE_CORRECTION_HINT, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.hint.perspective_correction; }},
      {GL_POINT_SMOOTH_HINT, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.hint.point_smooth; }},
      {GL_LINE_SMOOTH_HINT, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.hint.line_smooth; }},
      {GL_POLYGON_SMOOTH_HINT, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.hint.polygon_smooth; }},
      {GL_FOG_HINT, GetKind::enumeration, 1, [](const Context& c, double* out) { *out = c.hint.fog; }},
  };
  return kRows;
}

}  // namespace halfspace::state
