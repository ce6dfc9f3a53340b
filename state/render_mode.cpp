#include "state/render_mode.h"

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace {

class SelectionSink final : public raster::FeedbackSink {
 public:
  explicit SelectionSink(SelectionState& selection) : selection_(selection) {}
  bool needs_attributes() const override { return false; }
  void point(const raster::FeedbackVertex& v) override { record_hit(selection_, v.z); }
  void line(const raster::FeedbackVertex& a, const raster::FeedbackVertex& b, bool) override {
    record_hit(selection_, a.z);
    record_hit(selection_, b.z);
  }
  void polygon(std::span<const raster::FeedbackVertex> vertices) override {
    for (const raster::FeedbackVertex& v : vertices) record_hit(selection_, v.z);
  }

 private:
  SelectionState& selection_;
};

class FeedbackWriter final : public raster::FeedbackSink {
 public:
  explicit FeedbackWriter(FeedbackState& feedback) : feedback_(feedback) {}
  bool needs_attributes() const override { return feedback_.has_color(); }
  void point(const raster::FeedbackVertex& v) override {
    write_feedback(feedback_, GLfloat(GL_POINT_TOKEN));
    write_feedback_vertex(feedback_, v);
  }
  void line(const raster::FeedbackVertex& a, const raster::FeedbackVertex& b, bool reset) override {
    write_feedback(feedback_, GLfloat(reset ? GL_LINE_RESET_TOKEN : GL_LINE_TOKEN));
    write_feedback_vertex(feedback_, a);
    write_feedback_vertex(feedback_, b);
  }
  void polygon(std::span<const raster::FeedbackVertex> vertices) override {
    write_feedback(feedback_, GLfloat(GL_POLYGON_TOKEN));
    write_feedback(feedback_, GLfloat(vertices.size()));
    for (const raster::FeedbackVertex& v : vertices) write_feedback_vertex(feedback_, v);
  }

 private:
  FeedbackState& feedback_;
};

bool can_enter(const Context& context, GLenum mode) {
  if (mode == GL_SELECT) return context.selection.given;
  return mode == GL_RENDER || context.feedback.given;
}

// What glRenderMode answers: how much the mode that ends has written.
GLint leave(Context& context) {
  switch (context.render_mode.mode) {
    case GL_SELECT:
      return finish_selection(context.selection);
    case GL_FEEDBACK:
      return finish_feedback(context.feedback);
    default:
      return 0;
  }
}

}  // namespace

bool feedback_needs_tex_coord(const Context& context) {
  return context.render_mode.mode == GL_FEEDBACK && context.feedback.has_tex_coord();
}

void capture_draw(Context& context, const raster::DrawPacket& packet) {
  if (context.render_mode.mode == GL_SELECT) {
    SelectionSink sink(context.selection);
    context.device.feedback(packet, sink);
  } else {
    FeedbackWriter writer(context.feedback);
    context.device.feedback(packet, writer);
  }
}

void capture_raster_position(Context& context, double z) {
  if (context.render_mode.mode != GL_SELECT) return;
  flush_vertices(context);
  record_hit(context.selection, z);
}

void capture_pixels(Context& context, GLenum token, const raster::FeedbackVertex& at) {
  if (context.render_mode.mode != GL_FEEDBACK) return;
  flush_vertices(context);
  write_feedback(context.feedback, GLfloat(token));
  write_feedback_vertex(context.feedback, at);
}

namespace op {

GLint render_mode(Context& context, GLenum mode) {
  if (mode != GL_RENDER && mode != GL_SELECT && mode != GL_FEEDBACK) {
    record_error(context, GL_INVALID_ENUM);
    return 0;
  }
  if (!can_enter(context, mode)) {
    record_error(context, GL_INVALID_OPERATION);
    return 0;
  }
  flush_vertices(context);
  const GLint answer = leave(context);
  context.selection.depth = 0;
  context.render_mode.mode = mode;
  if (mode == GL_SELECT) start_selection(context.selection);
  if (mode == GL_FEEDBACK) start_feedback(context.feedback);
  return answer;
}

}  // namespace op

std::span<const GetRow> render_mode_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_RENDER_MODE, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.render_mode.mode; }},
  };
  return kRows;
}

}  // namespace halfspace::state
