#include "ref_app/gl_renderer.h"

#include <GL/gl.h>

#include <glm/gtc/type_ptr.hpp>

namespace ref_app {
namespace {

GLenum gl_primitive(Primitive primitive) {
  return primitive == Primitive::triangles ? GL_TRIANGLES : GL_QUADS;
}

void load_matrix(GLenum mode, const glm::mat4& matrix) {
  glMatrixMode(mode);
  glLoadMatrixf(glm::value_ptr(matrix));
}

void set_enabled(GLenum capability, bool enabled) {
  if (enabled) {
    glEnable(capability);
  } else {
    glDisable(capability);
  }
}

const char* error_name(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_STACK_OVERFLOW:
      return "GL_STACK_OVERFLOW";
    case GL_STACK_UNDERFLOW:
      return "GL_STACK_UNDERFLOW";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    default:
      return "an unknown GL error";
  }
}

}  // namespace

ImageHandle GlRenderer::add_image(const Image& image) {
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               image.rgba.data());
  return name;
}

void GlRenderer::remove_image(ImageHandle handle) {
  const GLuint name = handle;
  glDeleteTextures(1, &name);
}

void GlRenderer::begin_pass(const Pass& pass) {
  glViewport(0, 0, width_, height_);
  glClearColor(pass.clear_color.r, pass.clear_color.g, pass.clear_color.b, pass.clear_color.a);
  glClearDepth(static_cast<GLclampd>(pass.clear_depth));
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void GlRenderer::draw(const PipelineState& state, const Geometry& geometry) {
  if (geometry.indices.empty()) return;
  load_matrix(GL_PROJECTION, state.projection);
  load_matrix(GL_MODELVIEW, state.model_view);
  set_enabled(GL_DEPTH_TEST, state.depth_test);
  set_enabled(GL_TEXTURE_2D, state.texturing);
  if (state.texturing) glBindTexture(GL_TEXTURE_2D, state.image);

  constexpr GLsizei kStride = sizeof(Vertex);
  const Vertex& first = geometry.vertices.front();
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_COLOR_ARRAY);
  glEnableClientState(GL_TEXTURE_COORD_ARRAY);
  glVertexPointer(4, GL_FLOAT, kStride, &first.position);
  glColorPointer(4, GL_FLOAT, kStride, &first.color);
  glTexCoordPointer(2, GL_FLOAT, kStride, &first.tex_coord);
  glDrawElements(gl_primitive(geometry.primitive), static_cast<GLsizei>(geometry.indices.size()),
                 GL_UNSIGNED_INT, geometry.indices.data());
}

void GlRenderer::end_pass() { glFinish(); }

void GlRenderer::read_rows(int y, int rows, uint8_t* rgba) {
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, y, width_, rows, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
}

std::string take_gl_errors() {
  std::string names;
  // A context that is lost answers an error for ever: stop after one of each kind.
  for (int taken = 0; taken < 6; ++taken) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) break;
    if (!names.empty()) names += ", ";
    names += error_name(error);
  }
  return names;
}

std::string gl_string(unsigned name) {
  const GLubyte* text = glGetString(name);
  return text ? reinterpret_cast<const char*>(text) : "(none)";
}

}  // namespace ref_app
