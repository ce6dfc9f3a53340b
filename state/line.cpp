#include "state/line.h"

#include <algorithm>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace op {

void line_width(Context& context, GLfloat width) {
  if (!(width > 0)) return record_error(context, GL_INVALID_VALUE);  // NaN too
  context.line.width = width;
  mark_dirty(context, kDirtyRaster);
}

void line_stipple(Context& context, GLint factor, GLushort pattern) {
  context.line.repeat = std::clamp(factor, 1, 256);
  context.line.pattern = pattern;
  mark_dirty(context, kDirtyRaster);
}

}  // namespace op

std::span<const GetRow> line_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_LINE_WIDTH, GetKind::real, 1, [](const Context& c, double* out) { *out = double(c.line.width); }},
      {GL_LINE_WIDTH_RANGE, GetKind::real, 2,
       [](const Context&, double* out) {
         out[0] = 1;
         out[1] = double(raster::kMaxLineWidth);
       }},
      {GL_LINE_WIDTH_GRANULARITY, GetKind::real, 1,
       [](const Context&, double* out) { *out = raster::kSizeGranularity; }},
      {GL_LINE_STIPPLE_PATTERN, GetKind::integer, 1,
       [](const Context& c, double* out) { *out = c.line.pattern; }},
      {GL_LINE_STIPPLE_REPEAT, GetKind::integer, 1,
       [](const Context& c, double* out) { *out = c.line.repeat; }},
  };
  return kRows;
}

}  // namespace halfspace::state
