// glTexParameter and its queries (spec 3.8.4, 6.1.3).
#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"
#include "state/texture_argument.h"

namespace halfspace::state {
namespace {

bool is_min_filter(GLenum v) {
  return v == GL_NEAREST || v == GL_LINEAR ||
         (v >= GL_NEAREST_MIPMAP_NEAREST && v <= GL_LINEAR_MIPMAP_LINEAR);
}
bool is_mag_filter(GLenum v) { return v == GL_NEAREST || v == GL_LINEAR; }
bool is_wrap(GLenum v) { return v == GL_REPEAT || v == GL_CLAMP || v == GL_CLAMP_TO_EDGE; }

struct EnumParameter {
  GLenum name;
  GLenum TextureParameters::*value;
  bool (*accepts)(GLenum);
};
constexpr EnumParameter kEnumParameters[] = {
    {GL_TEXTURE_MIN_FILTER, &TextureParameters::min_filter, is_min_filter},
    {GL_TEXTURE_MAG_FILTER, &TextureParameters::mag_filter, is_mag_filter},
    {GL_TEXTURE_WRAP_S, &TextureParameters::wrap_s, is_wrap},
    {GL_TEXTURE_WRAP_T, &TextureParameters::wrap_t, is_wrap},
};

const EnumParameter* find_enum_parameter(GLenum pname) {
  for (const EnumParameter& parameter : kEnumParameters) {
    if (parameter.name == pname) return &parameter;
  }
  return nullptr;
}

// GL_NO_ERROR and `out` changed, or what is wrong.
template <class T>
GLenum apply_parameter(TextureParameters& out, GLenum pname, const T* params) {
  if (const EnumParameter* parameter = find_enum_parameter(pname)) {
    const GLenum value = enum_argument(params[0]);
    if (!parameter->accepts(value)) return GL_INVALID_ENUM;
    out.*parameter->value = value;
    return GL_NO_ERROR;
  }
  switch (pname) {
    case GL_TEXTURE_BORDER_COLOR:
      out.border_color = color_argument(params);
      return GL_NO_ERROR;
    case GL_TEXTURE_PRIORITY:
      out.priority = unit_argument(params[0]);
      return GL_NO_ERROR;
    default:
      return GL_INVALID_ENUM;
  }
}

template <class T>
void set_parameter(Context& context, GLenum target, GLenum pname, const T* params, const char* operation) {
  TextureObject* object = bound_texture(context, target);
  if (object == nullptr) return record_error(context, GL_INVALID_ENUM, operation);
  const std::lock_guard lock(object->mutex);
  const GLenum error = apply_parameter(object->parameters, pname, params);
  if (error != GL_NO_ERROR) return record_error(context, error, operation);
  touch_texture(context, *object);
}

Answer parameter_answer(Context& context, GLenum target, GLenum pname) {
  TextureObject* object = bound_texture(context, target);
  if (object == nullptr) return refusal(GL_INVALID_ENUM);
  const std::lock_guard lock(object->mutex);
  const TextureParameters& parameters = object->parameters;
  if (const EnumParameter* parameter = find_enum_parameter(pname)) {
    return scalar_answer(GetKind::enumeration, parameters.*parameter->value);
  }
  switch (pname) {
    case GL_TEXTURE_BORDER_COLOR:
      return color_answer(parameters.border_color);
    case GL_TEXTURE_PRIORITY:
      return scalar_answer(GetKind::normalized, double(parameters.priority));
    case GL_TEXTURE_RESIDENT:
      return scalar_answer(GetKind::boolean, 1);  // memory is all there is
    default:
      return refusal(GL_INVALID_ENUM);
  }
}

}  // namespace

namespace op {

void tex_parameterfv(Context& context, GLenum target, GLenum pname, const GLfloat* params) {
  set_parameter(context, target, pname, params, __func__);
}

void tex_parameteriv(Context& context, GLenum target, GLenum pname, const GLint* params) {
  set_parameter(context, target, pname, params, __func__);
}

void get_tex_parameterfv(Context& context, GLenum target, GLenum pname, GLfloat* params) {
  give_answer(context, parameter_answer(context, target, pname), params);
}

void get_tex_parameteriv(Context& context, GLenum target, GLenum pname, GLint* params) {
  give_answer(context, parameter_answer(context, target, pname), params);
}

}  // namespace op
}  // namespace halfspace::state
