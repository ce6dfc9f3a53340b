// glTexEnv and its queries (spec 3.8.13).
#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"
#include "state/texture_argument.h"

namespace halfspace::state {
namespace {

bool is_env_mode(GLenum v) { return v == GL_MODULATE || v == GL_DECAL || v == GL_BLEND || v == GL_REPLACE; }

template <class T>
void set_env(Context& context, GLenum target, GLenum pname, const T* params, const char* operation) {
  if (target != GL_TEXTURE_ENV) return record_error(context, GL_INVALID_ENUM, operation);
  if (pname == GL_TEXTURE_ENV_MODE) {
    const GLenum mode = enum_argument(params[0]);
    if (!is_env_mode(mode)) return record_error(context, GL_INVALID_ENUM, operation);
    if (mode == context.texture.env_mode) return;
    context.texture.env_mode = mode;
  } else if (pname == GL_TEXTURE_ENV_COLOR) {
    context.texture.env_color = color_argument(params);
  } else {
    return record_error(context, GL_INVALID_ENUM, operation);
  }
  touch_texture_unit(context);
}

Answer env_answer(const Context& context, GLenum target, GLenum pname) {
  if (target == GL_TEXTURE_ENV && pname == GL_TEXTURE_ENV_MODE)
    return scalar_answer(GetKind::enumeration, context.texture.env_mode);
  if (target == GL_TEXTURE_ENV && pname == GL_TEXTURE_ENV_COLOR)
    return color_answer(context.texture.env_color);
  return refusal(GL_INVALID_ENUM);
}

}  // namespace

raster::EnvMode texture_env_mode(const Context& context) {
  switch (context.texture.env_mode) {
    case GL_DECAL:
      return raster::EnvMode::decal;
    case GL_BLEND:
      return raster::EnvMode::blend;
    case GL_REPLACE:
      return raster::EnvMode::replace;
    default:
      return raster::EnvMode::modulate;
  }
}

raster::Color texture_env_color(const Context& context) { return context.texture.env_color; }

namespace op {

void tex_envfv(Context& context, GLenum target, GLenum pname, const GLfloat* params) {
  set_env(context, target, pname, params, __func__);
}

void tex_enviv(Context& context, GLenum target, GLenum pname, const GLint* params) {
  set_env(context, target, pname, params, __func__);
}

void get_tex_envfv(Context& context, GLenum target, GLenum pname, GLfloat* params) {
  give_answer(context, env_answer(context, target, pname), params);
}

void get_tex_enviv(Context& context, GLenum target, GLenum pname, GLint* params) {
  give_answer(context, env_answer(context, target, pname), params);
}

}  // namespace op
}  // namespace halfspace::state
