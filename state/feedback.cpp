#include "state/feedback.h"

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace {

bool is_feedback_type(GLenum type) { return type >= GL_2D && type <= GL_4D_COLOR_TEXTURE; }
static_assert(GL_3D == GL_2D + 1 && GL_3D_COLOR == GL_2D + 2 && GL_3D_COLOR_TEXTURE == GL_2D + 3 &&
              GL_4D_COLOR_TEXTURE == GL_2D + 4);

}  // namespace

void start_feedback(FeedbackState& feedback) { feedback.written = 0; }

GLint finish_feedback(const FeedbackState& feedback) {
  return feedback.written > feedback.size ? -1 : GLint(feedback.written);
}

void write_feedback(FeedbackState& feedback, GLfloat value) {
  if (feedback.written < feedback.size) feedback.buffer[feedback.written] = value;
  ++feedback.written;
}

// Spec table 5.1: what a vertex has, by type.
void write_feedback_vertex(FeedbackState& feedback, const raster::FeedbackVertex& v) {
  const auto write = [&feedback](auto... values) { (write_feedback(feedback, GLfloat(values)), ...); };
  write(v.x, v.y);
  if (feedback.type != GL_2D) write(v.z);
  if (feedback.type == GL_4D_COLOR_TEXTURE) write(v.w);
  if (feedback.has_color()) write(v.color.r, v.color.g, v.color.b, v.color.a);
  if (feedback.has_tex_coord()) write(v.s, v.t, v.r, v.q);
}

namespace op {

void feedback_buffer(Context& context, GLsizei size, GLenum type, GLfloat* buffer) {
  if (!is_feedback_type(type)) return record_error(context, GL_INVALID_ENUM);
  if (size < 0) return record_error(context, GL_INVALID_VALUE);
  if (context.render_mode.mode == GL_FEEDBACK) return record_error(context, GL_INVALID_OPERATION);
  context.feedback.given = true;
  context.feedback.buffer = buffer;
  context.feedback.size = buffer ? size_t(size) : 0;
  context.feedback.type = type;
}

void pass_through(Context& context, GLfloat token) {
  if (context.render_mode.mode != GL_FEEDBACK) return;
  flush_vertices(context);
  write_feedback(context.feedback, GLfloat(GL_PASS_THROUGH_TOKEN));
  write_feedback(context.feedback, token);
}

}  // namespace op

std::span<const GetRow> feedback_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_FEEDBACK_BUFFER_SIZE, GetKind::integer, 1,
       [](const Context& c, double* out) { *out = double(c.feedback.size); }},
      {GL_FEEDBACK_BUFFER_TYPE, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.feedback.type; }},
  };
  return kRows;
}

}  // namespace halfspace::state
