#include "state/stencil.h"

#include <algorithm>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace {

bool is_stencil_op(GLenum name) {
  switch (name) {
    case GL_KEEP:
    case GL_ZERO:
    case GL_REPLACE:
    case GL_INCR:
    case GL_DECR:
    case GL_INVERT:
      return true;
    default:
      return false;
  }
}

raster::StencilOp stencil_op_of(GLenum name) {
  switch (name) {
    case GL_ZERO:
      return raster::StencilOp::zero;
    case GL_REPLACE:
      return raster::StencilOp::replace;
    case GL_INCR:
      return raster::StencilOp::increment;
    case GL_DECR:
      return raster::StencilOp::decrement;
    case GL_INVERT:
      return raster::StencilOp::invert;
    default:
      return raster::StencilOp::keep;
  }
}

// Clamped to [0, 2^bits - 1]. A visual without stencil keeps what was given.
GLint clamped_reference(const Context& context) {
  const GLint reference = std::max(context.stencil_buffer.reference, 0);
  const int bits = context.visual.stencil_bits;
  return bits > 0 ? std::min(reference, (1 << bits) - 1) : reference;
}

}  // namespace

raster::StencilState derive_stencil(const Context& context) {
  const StencilBufferState& s = context.stencil_buffer;
  raster::StencilState out;
  out.test = s.test && context.visual.stencil_bits > 0;
  out.func = raster::CompareFunc(s.func - GL_NEVER);
  out.reference = uint8_t(clamped_reference(context));
  out.compare_mask = uint8_t(s.value_mask);
  out.write_mask = uint8_t(s.write_mask);
  out.fail = stencil_op_of(s.fail);
  out.depth_fail = stencil_op_of(s.depth_fail);
  out.depth_pass = stencil_op_of(s.depth_pass);
  return out;
}

namespace op {

void stencil_func(Context& context, GLenum func, GLint reference, GLuint mask) {
  if (func < GL_NEVER || func > GL_ALWAYS) return record_error(context, GL_INVALID_ENUM);
  StencilBufferState& s = context.stencil_buffer;
  s.func = func;
  s.reference = reference;
  s.value_mask = mask;
  mark_dirty(context, kDirtyFragment);
}

void stencil_op(Context& context, GLenum fail, GLenum depth_fail, GLenum depth_pass) {
  if (!is_stencil_op(fail) || !is_stencil_op(depth_fail) || !is_stencil_op(depth_pass))
    return record_error(context, GL_INVALID_ENUM);
  StencilBufferState& s = context.stencil_buffer;
  s.fail = fail;
  s.depth_fail = depth_fail;
  s.depth_pass = depth_pass;
  mark_dirty(context, kDirtyFragment);
}

void stencil_mask(Context& context, GLuint mask) {
  context.stencil_buffer.write_mask = mask;
  mark_dirty(context, kDirtyFragment);
}

void clear_stencil(Context& context, GLint s) { context.stencil_buffer.clear_value = s; }

}  // namespace op

std::span<const GetRow> stencil_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_STENCIL_FUNC, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.stencil_buffer.func; }},
      {GL_STENCIL_REF, GetKind::integer, 1,
       [](const Context& c, double* out) { *out = clamped_reference(c); }},
      {GL_STENCIL_VALUE_MASK, GetKind::integer, 1,
       [](const Context& c, double* out) { *out = c.stencil_buffer.value_mask; }},
      {GL_STENCIL_FAIL, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.stencil_buffer.fail; }},
      {GL_STENCIL_PASS_DEPTH_FAIL, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.stencil_buffer.depth_fail; }},
      {GL_STENCIL_PASS_DEPTH_PASS, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.stencil_buffer.depth_pass; }},
      {GL_STENCIL_WRITEMASK, GetKind::integer, 1,
       [](const Context& c, double* out) { *out = c.stencil_buffer.write_mask; }},
      {GL_STENCIL_CLEAR_VALUE, GetKind::integer, 1,
       [](const Context& c, double* out) { *out = c.stencil_buffer.clear_value; }},
  };
  return kRows;
}

}  // namespace halfspace::state
