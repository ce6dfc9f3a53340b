// Feedback (spec 5.3): primitives come back as numbers instead of pixels.
#pragma once

#include <cstddef>

#include "raster/api/feedback.h"
#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

struct FeedbackState {
  bool given = false;  // glFeedbackBuffer has been called
  GLfloat* buffer = nullptr;
  size_t size = 0;     // floats
  size_t written = 0;  // floats so far, with those there was no room for
  GLenum type = GL_2D;

  bool has_color() const { return type != GL_2D && type != GL_3D; }
  bool has_tex_coord() const { return type == GL_3D_COLOR_TEXTURE || type == GL_4D_COLOR_TEXTURE; }
};

// Entering and leaving GL_FEEDBACK; leaving gives the number of floats, or -1 if there were too many.
void start_feedback(FeedbackState& feedback);
GLint finish_feedback(const FeedbackState& feedback);

void write_feedback(FeedbackState& feedback, GLfloat value);
void write_feedback_vertex(FeedbackState& feedback, const raster::FeedbackVertex& vertex);

}  // namespace halfspace::state
