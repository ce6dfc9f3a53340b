#include "state/point.h"

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace op {

void point_size(Context& context, GLfloat size) {
  if (!(size > 0)) return record_error(context, GL_INVALID_VALUE);  // NaN too
  context.point.size = size;
  mark_dirty(context, kDirtyRaster);
}

}  // namespace op

std::span<const GetRow> point_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_POINT_SIZE, GetKind::real, 1, [](const Context& c, double* out) { *out = double(c.point.size); }},
      {GL_POINT_SIZE_RANGE, GetKind::real, 2,
       [](const Context&, double* out) {
         out[0] = 1;
         out[1] = double(raster::kMaxPointSize);
       }},
      {GL_POINT_SIZE_GRANULARITY, GetKind::real, 1,
       [](const Context&, double* out) { *out = raster::kSizeGranularity; }},
  };
  return kRows;
}

}  // namespace halfspace::state
