// glGetString (spec 6.1.11).
#include <string>

#include "raster/api/device.h"
#include "state/context.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace {

const char* renderer() {
  static const std::string text = "Halfspace " + std::string(raster::isa_name());
  return text.c_str();
}

const char* text_of(GLenum name) {
  switch (name) {
    case GL_VENDOR:
      return "Halfspace";
    case GL_RENDERER:
      return renderer();
    case GL_VERSION:
      return "1.1 Halfspace " HALFSPACE_VERSION;
    // Only what works: GL_BGRA and GL_BGR(A) images, GL_CLAMP_TO_EDGE, the blend factors of blend_square.
    case GL_EXTENSIONS:
      return "GL_ARB_window_pos GL_EXT_bgra GL_EXT_subtexture GL_EXT_texture_edge_clamp "
             "GL_EXT_texture_object GL_EXT_vertex_array GL_HALFSPACE_accuracy "
             "GL_NV_blend_square GL_SGIS_texture_edge_clamp";
    default:
      return nullptr;
  }
}

}  // namespace

namespace op {

const GLubyte* get_string(Context& context, GLenum name) {
  const char* text = text_of(name);
  if (!text) record_error(context, GL_INVALID_ENUM);
  return reinterpret_cast<const GLubyte*>(text);
}

}  // namespace op
}  // namespace halfspace::state
