#include "state/depth_buffer.h"

#include <algorithm>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace op {

void depth_func(Context& context, GLenum func) {
  if (func < GL_NEVER || func > GL_ALWAYS) return record_error(context, GL_INVALID_ENUM);
  context.depth_buffer.func = func;
  mark_dirty(context, kDirtyFragment);
}

void depth_mask(Context& context, GLboolean flag) {
  context.depth_buffer.write = flag != GL_FALSE;
  mark_dirty(context, kDirtyFragment);
}

void clear_depth(Context& context, GLclampd depth) {
  context.depth_buffer.clear_value = depth > 0 ? std::min(depth, 1.0) : 0.0;  // NaN becomes 0
}

}  // namespace op

std::span<const GetRow> depth_buffer_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_DEPTH_FUNC, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.depth_buffer.func; }},
      {GL_DEPTH_WRITEMASK, GetKind::boolean, 1,
       [](const Context& c, double* out) { *out = c.depth_buffer.write; }},
      {GL_DEPTH_CLEAR_VALUE, GetKind::normalized, 1,
       [](const Context& c, double* out) { *out = c.depth_buffer.clear_value; }},
  };
  return kRows;
}

}  // namespace halfspace::state
