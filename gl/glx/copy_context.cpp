#include "gl/glx/copy_context.h"

namespace halfspace::gl::glx {
namespace {

using namespace state;

// The group GL_ENABLE_BIT takes from the others (spec 6.1.14, table 6.6 and on).
void copy_enables(const Context& from, Context& to) {
  to.color_buffer.alpha_test = from.color_buffer.alpha_test;
  to.color_buffer.blend = from.color_buffer.blend;
  to.color_buffer.dither = from.color_buffer.dither;
  to.depth_buffer.test = from.depth_buffer.test;
  to.polygon.cull = from.polygon.cull;
  to.scissor.test = from.scissor.test;
  to.texture.enabled_1d = from.texture.enabled_1d;
  to.texture.enabled_2d = from.texture.enabled_2d;
}

void copy_depth(const Context& from, Context& to) {
  const GLint stencil_clear_value = to.depth_buffer.stencil_clear_value;  // of another group
  to.depth_buffer = from.depth_buffer;
  to.depth_buffer.stencil_clear_value = stencil_clear_value;
}

void copy_colors(const Context& from, Context& to) {
  const GLenum read_buffer = to.color_buffer.read_buffer;  // GL_PIXEL_MODE_BIT's
  const GLenum draw_buffer = to.color_buffer.draw_buffer;
  to.color_buffer = from.color_buffer;
  to.color_buffer.read_buffer = read_buffer;
  // A buffer the other visual lacks stays out.
  if (!from.was_current || from.visual.double_buffered != to.visual.double_buffered)
    to.color_buffer.draw_buffer = draw_buffer;
}

void copy_parameters(TextureObject& from, TextureObject& to) {
  if (&from == &to) return;
  const std::scoped_lock lock(from.mutex, to.mutex);
  to.parameters = from.parameters;
}

// Bound objects go along only where both contexts know them by the same names.
void copy_textures(const Context& from, Context& to) {
  to.texture.enabled_1d = from.texture.enabled_1d;
  to.texture.enabled_2d = from.texture.enabled_2d;
  to.texture.env_mode = from.texture.env_mode;
  to.texture.env_color = from.texture.env_color;
  copy_parameters(*from.texture.default_1d, *to.texture.default_1d);
  copy_parameters(*from.texture.default_2d, *to.texture.default_2d);
  touch_texture(to, *to.texture.default_1d);
  touch_texture(to, *to.texture.default_2d);
  if (from.texture.names == to.texture.names) {
    const auto counterpart = [](const auto& bound, const auto& from_default, const auto& to_default) {
      return bound == from_default ? to_default : bound;
    };
    to.texture.bound_1d = counterpart(from.texture.bound_1d, from.texture.default_1d, to.texture.default_1d);
    to.texture.bound_2d = counterpart(from.texture.bound_2d, from.texture.default_2d, to.texture.default_2d);
  }
  touch_texture_unit(to);
}

}  // namespace

void copy_attributes(const Context& from, Context& to, unsigned long mask) {
  if (mask & GL_CURRENT_BIT) to.current = from.current;
  if (mask & GL_VIEWPORT_BIT) to.viewport = from.viewport;
  if (mask & GL_TRANSFORM_BIT) to.transform.mode = from.transform.mode;
  if (mask & GL_SCISSOR_BIT) to.scissor = from.scissor;
  if (mask & GL_POLYGON_BIT) to.polygon = from.polygon;
  if (mask & GL_LIGHTING_BIT) to.lighting = from.lighting;
  if (mask & GL_DEPTH_BUFFER_BIT) copy_depth(from, to);
  if (mask & GL_STENCIL_BUFFER_BIT)
    to.depth_buffer.stencil_clear_value = from.depth_buffer.stencil_clear_value;
  if (mask & GL_COLOR_BUFFER_BIT) copy_colors(from, to);
  if (mask & GL_PIXEL_MODE_BIT && from.visual.double_buffered == to.visual.double_buffered)
    to.color_buffer.read_buffer = from.color_buffer.read_buffer;
  if (mask & GL_HINT_BIT) to.hint = from.hint;
  if (mask & GL_ENABLE_BIT) copy_enables(from, to);
  if (mask & GL_TEXTURE_BIT) copy_textures(from, to);
  mark_dirty(to, kDirtyAll);
}

}  // namespace halfspace::gl::glx
