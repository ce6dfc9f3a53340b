#include "state/scissor.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {

raster::Rect ScissorState::rect() const {
  const auto end = [](int start, int size) {
    return int(std::min<int64_t>(int64_t{start} + size, std::numeric_limits<int>::max()));
  };
  return {x, y, end(x, width), end(y, height)};
}

namespace op {

void scissor(Context& context, GLint x, GLint y, GLsizei width, GLsizei height) {
  if (width < 0 || height < 0) return record_error(context, GL_INVALID_VALUE);
  ScissorState& s = context.scissor;
  s.x = x;
  s.y = y;
  s.width = width;
  s.height = height;
  mark_dirty(context, kDirtyRaster);
}

}  // namespace op

std::span<const GetRow> scissor_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_SCISSOR_BOX, GetKind::integer, 4,
       [](const Context& c, double* out) {
         out[0] = c.scissor.x;
         out[1] = c.scissor.y;
         out[2] = c.scissor.width;
         out[3] = c.scissor.height;
       }},
  };
  return kRows;
}

}  // namespace halfspace::state
