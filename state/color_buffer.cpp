#include "state/color_buffer.h"

#include <algorithm>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"

namespace halfspace::state {
namespace {

float clamp_unit(float v) { return v > 0 ? std::min(v, 1.0f) : 0.0f; }  // NaN becomes 0

// GL_SRC_COLOR as a source and GL_DST_COLOR as a destination factor came with GL_NV_blend_square.
bool is_blend_factor(GLenum factor, bool source) {
  switch (factor) {
    case GL_ZERO:
    case GL_ONE:
    case GL_SRC_COLOR:
    case GL_ONE_MINUS_SRC_COLOR:
    case GL_DST_COLOR:
    case GL_ONE_MINUS_DST_COLOR:
    case GL_SRC_ALPHA:
    case GL_ONE_MINUS_SRC_ALPHA:
    case GL_DST_ALPHA:
    case GL_ONE_MINUS_DST_ALPHA:
      return true;
    case GL_SRC_ALPHA_SATURATE:
      return source;
    default:
      return false;
  }
}

// Which of a drawable's colour buffers a name of spec table 4.4 stands for.
enum BufferBits { kFrontLeft = 1, kBackLeft = 2, kRight = 4, kAuxiliary = 8, kUnknownBuffer = -1 };

int buffer_bits(GLenum mode) {
  switch (mode) {
    case GL_FRONT_LEFT:
      return kFrontLeft;
    case GL_BACK_LEFT:
      return kBackLeft;
    case GL_FRONT:
      return kFrontLeft | kRight;
    case GL_BACK:
      return kBackLeft | kRight;
    case GL_LEFT:
    case GL_FRONT_AND_BACK:
      return kFrontLeft | kBackLeft;
    case GL_FRONT_RIGHT:
    case GL_BACK_RIGHT:
    case GL_RIGHT:
      return kRight;
    case GL_AUX0:
    case GL_AUX1:
    case GL_AUX2:
    case GL_AUX3:
      return kAuxiliary;
    default:
      return kUnknownBuffer;
  }
}

int existing_buffers(const VisualConfig& visual) {
  return visual.double_buffered ? kFrontLeft | kBackLeft : kFrontLeft;
}

Drawable* reading_drawable(const Context& context) {
  return context.read_drawable ? context.read_drawable : context.drawable;
}

// A front end may show a drawable without a back buffer to a context whose visual has one.
uint8_t planes_of(GLenum mode, const Context& context, const Drawable* drawable) {
  const int bits = mode == GL_NONE ? 0 : buffer_bits(mode) & existing_buffers(context.visual);
  const VisualConfig& visual = drawable ? drawable->visual() : context.visual;
  if (!visual.double_buffered) return bits ? raster::kBackPlane : 0;
  return uint8_t((bits & kBackLeft ? raster::kBackPlane : 0) | (bits & kFrontLeft ? raster::kFrontPlane : 0));
}

}  // namespace

uint8_t draw_planes(const Context& context) {
  return planes_of(context.color_buffer.draw_buffer, context, context.drawable);
}

raster::ColorPlane read_plane(const Context& context) {
  const uint8_t planes = planes_of(context.color_buffer.read_buffer, context, reading_drawable(context));
  return planes & raster::kFrontPlane ? raster::kFrontPlane : raster::kBackPlane;
}

raster::Framebuffer* draw_framebuffer(Context& context) {
  flush_vertices(context);
  return context.drawable ? &context.drawable->framebuffer(draw_planes(context)) : nullptr;
}

raster::Framebuffer* read_framebuffer(Context& context) {
  flush_vertices(context);
  Drawable* drawable = reading_drawable(context);
  return drawable ? &drawable->framebuffer(read_plane(context)) : nullptr;
}

namespace op {

void alpha_func(Context& context, GLenum func, GLclampf reference) {
  if (func < GL_NEVER || func > GL_ALWAYS) return record_error(context, GL_INVALID_ENUM);
  context.color_buffer.alpha_func = func;
  context.color_buffer.alpha_reference = clamp_unit(reference);
  mark_dirty(context, kDirtyFragment);
}

void blend_func(Context& context, GLenum src, GLenum dst) {
  if (!is_blend_factor(src, true) || !is_blend_factor(dst, false))
    return record_error(context, GL_INVALID_ENUM);
  context.color_buffer.blend_src = src;
  context.color_buffer.blend_dst = dst;
  mark_dirty(context, kDirtyFragment);
}

void logic_op(Context& context, GLenum op) {
  if (op < GL_CLEAR || op > GL_SET) return record_error(context, GL_INVALID_ENUM);
  context.color_buffer.logic_op = op;
  mark_dirty(context, kDirtyFragment);
}

void color_mask(Context& context, GLboolean r, GLboolean g, GLboolean b, GLboolean a) {
  context.color_buffer.mask = {r != GL_FALSE, g != GL_FALSE, b != GL_FALSE, a != GL_FALSE};
  mark_dirty(context, kDirtyFragment);
}

void clear_color(Context& context, GLclampf r, GLclampf g, GLclampf b, GLclampf a) {
  context.color_buffer.clear_color = {clamp_unit(r), clamp_unit(g), clamp_unit(b), clamp_unit(a)};
}

void clear_index(Context& context, GLfloat c) { context.color_buffer.clear_index = c; }

void index_mask(Context& context, GLuint mask) { context.color_buffer.index_mask = mask; }

void draw_buffer(Context& context, GLenum mode) {
  const int bits = mode == GL_NONE ? 0 : buffer_bits(mode);
  if (bits == kUnknownBuffer) return record_error(context, GL_INVALID_ENUM);
  if (mode != GL_NONE && !(bits & existing_buffers(context.visual)))
    return record_error(context, GL_INVALID_OPERATION);
  if (mode == context.color_buffer.draw_buffer) return;
  // What was drawn to a visible buffer comes to light now: later flushes are about the new one.
  guard_memory(context, [&] {
    execute_drawing(context);
    context.color_buffer.draw_buffer = mode;
    mark_dirty(context, kDirtyFragment);
  });
}

void read_buffer(Context& context, GLenum mode) {
  const int bits = buffer_bits(mode);
  if (bits == kUnknownBuffer || mode == GL_FRONT_AND_BACK) return record_error(context, GL_INVALID_ENUM);
  if (!(bits & existing_buffers(context.visual))) return record_error(context, GL_INVALID_OPERATION);
  context.color_buffer.read_buffer = mode;
}

}  // namespace op

std::span<const GetRow> color_buffer_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_ALPHA_TEST_FUNC, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.color_buffer.alpha_func; }},
      {GL_ALPHA_TEST_REF, GetKind::normalized, 1,
       [](const Context& c, double* out) { *out = double(c.color_buffer.alpha_reference); }},
      {GL_BLEND_SRC, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.color_buffer.blend_src; }},
      {GL_BLEND_DST, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.color_buffer.blend_dst; }},
      {GL_LOGIC_OP_MODE, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.color_buffer.logic_op; }},
      {GL_COLOR_WRITEMASK, GetKind::boolean, 4,
       [](const Context& c, double* out) {
         const raster::ColorMask& mask = c.color_buffer.mask;
         out[0] = mask.r;
         out[1] = mask.g;
         out[2] = mask.b;
         out[3] = mask.a;
       }},
      {GL_COLOR_CLEAR_VALUE, GetKind::normalized, 4,
       [](const Context& c, double* out) {
         const raster::Color& color = c.color_buffer.clear_color;
         out[0] = double(color.r);
         out[1] = double(color.g);
         out[2] = double(color.b);
         out[3] = double(color.a);
       }},
      {GL_INDEX_CLEAR_VALUE, GetKind::real, 1,
       [](const Context& c, double* out) { *out = double(c.color_buffer.clear_index); }},
      {GL_INDEX_WRITEMASK, GetKind::integer, 1,
       [](const Context& c, double* out) { *out = c.color_buffer.index_mask; }},
      {GL_DRAW_BUFFER, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.color_buffer.draw_buffer; }},
      {GL_READ_BUFFER, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.color_buffer.read_buffer; }},
  };
  return kRows;
}

}  // namespace halfspace::state
