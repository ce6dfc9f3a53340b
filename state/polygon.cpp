#include "state/polygon.h"

#include <atomic>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"
#include "state/report.h"

namespace halfspace::state {
namespace {

bool is_face(GLenum face) { return face == GL_FRONT || face == GL_BACK || face == GL_FRONT_AND_BACK; }

void report_polygon_mode(GLenum mode) {
  static std::atomic<bool> reported = false;
  if (mode == GL_FILL || reported.exchange(true)) return;
  report("glPolygonMode(%s) has no effect yet", mode == GL_LINE ? "GL_LINE" : "GL_POINT");
}

}  // namespace

namespace op {

void cull_face(Context& context, GLenum mode) {
  if (!is_face(mode)) return record_error(context, GL_INVALID_ENUM);
  context.polygon.cull_face = mode;
  mark_dirty(context, kDirtyRaster);
}

void front_face(Context& context, GLenum mode) {
  if (mode != GL_CW && mode != GL_CCW) return record_error(context, GL_INVALID_ENUM);
  context.polygon.front_face = mode;
  mark_dirty(context, kDirtyRaster);
}

void polygon_mode(Context& context, GLenum face, GLenum mode) {
  const bool known = mode == GL_POINT || mode == GL_LINE || mode == GL_FILL;
  if (!is_face(face) || !known) return record_error(context, GL_INVALID_ENUM);
  if (face != GL_BACK) context.polygon.mode[0] = mode;
  if (face != GL_FRONT) context.polygon.mode[1] = mode;
  mark_dirty(context, kDirtyRaster);
  report_polygon_mode(mode);
}

}  // namespace op

std::span<const GetRow> polygon_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_CULL_FACE_MODE, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.polygon.cull_face; }},
      {GL_FRONT_FACE, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.polygon.front_face; }},
      {GL_POLYGON_MODE, GetKind::enumeration, 2,
       [](const Context& c, double* out) {
         out[0] = c.polygon.mode[0];
         out[1] = c.polygon.mode[1];
       }},
  };
  return kRows;
}

}  // namespace halfspace::state
