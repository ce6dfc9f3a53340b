#include "state/lighting.h"

#include <algorithm>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"
#include "state/texture_argument.h"
#include "state/trigonometry.h"

namespace halfspace::state {
namespace {

using raster::Color;
using raster::Light;

Light* find_light(Context& context, GLenum light) {
  const GLenum index = light - GL_LIGHT0;
  return index < GLenum{raster::kMaxLights} ? &context.lighting.lights[index] : nullptr;
}

// Lights' colours are not clamped (spec 2.14.1).
Color color_of(const GLfloat* v) { return {v[0], v[1], v[2], v[3]}; }

bool is_light_value(GLenum pname, GLfloat value) {
  switch (pname) {
    case GL_SPOT_EXPONENT:
      return value >= 0 && value <= 128;
    case GL_SPOT_CUTOFF:
      return (value >= 0 && value <= 90) || value == 180;
    case GL_CONSTANT_ATTENUATION:
    case GL_LINEAR_ATTENUATION:
    case GL_QUADRATIC_ATTENUATION:
      return value >= 0;
    default:
      return true;
  }
}

// Positions and directions go through the modelview matrix of when they are given (spec 2.14.1).
std::array<double, 4> eye_position(const Context& context, const GLfloat* v) {
  const Matrix& m = context.transform.modelview.top();
  std::array<double, 4> eye;
  for (size_t row = 0; row < 4; ++row) {
    eye[row] = double(m[row]) * double(v[0]) + double(m[4 + row]) * double(v[1]) +
               double(m[8 + row]) * double(v[2]) + double(m[12 + row]) * double(v[3]);
  }
  return eye;
}

std::array<double, 3> eye_direction(const Context& context, const GLfloat* v) {
  const float direction[4] = {v[0], v[1], v[2], 0};
  const std::array<double, 4> eye = eye_position(context, direction);
  return {eye[0], eye[1], eye[2]};
}

void set_cutoff(Light& light, float degrees) {
  light.spot_cutoff = degrees;
  light.spot_cosine = sine_cosine_degrees(double(degrees)).cosine;
}

// False: `pname` is none of a light.
bool set_light(const Context& context, Light& light, GLenum pname, const GLfloat* params) {
  switch (pname) {
    case GL_AMBIENT:
      return light.ambient = color_of(params), true;
    case GL_DIFFUSE:
      return light.diffuse = color_of(params), true;
    case GL_SPECULAR:
      return light.specular = color_of(params), true;
    case GL_POSITION:
      return light.position = eye_position(context, params), true;
    case GL_SPOT_DIRECTION:
      return light.spot_direction = eye_direction(context, params), true;
    case GL_SPOT_EXPONENT:
      return light.spot_exponent = *params, true;
    case GL_SPOT_CUTOFF:
      return set_cutoff(light, *params), true;
    case GL_CONSTANT_ATTENUATION:
      return light.constant_attenuation = *params, true;
    case GL_LINEAR_ATTENUATION:
      return light.linear_attenuation = *params, true;
    case GL_QUADRATIC_ATTENUATION:
      return light.quadratic_attenuation = *params, true;
    default:
      return false;
  }
}

template <class T, size_t kCount>
void write_numbers(T* out, const std::array<double, kCount>& values) {
  for (size_t i = 0; i < kCount; ++i) write_answer(out + i, values[i], GetKind::real);
}

template <class T>
void get_light(Context& context, GLenum name, GLenum pname, T* params, const char* operation) {
  const Light* light = find_light(context, name);
  if (!light) return record_error(context, GL_INVALID_ENUM, operation);
  switch (pname) {
    case GL_AMBIENT:
      return write_color_answer(params, light->ambient);
    case GL_DIFFUSE:
      return write_color_answer(params, light->diffuse);
    case GL_SPECULAR:
      return write_color_answer(params, light->specular);
    case GL_POSITION:
      return write_numbers(params, light->position);
    case GL_SPOT_DIRECTION:
      return write_numbers(params, light->spot_direction);
    case GL_SPOT_EXPONENT:
      return write_answer(params, double(light->spot_exponent), GetKind::real);
    case GL_SPOT_CUTOFF:
      return write_answer(params, double(light->spot_cutoff), GetKind::real);
    case GL_CONSTANT_ATTENUATION:
      return write_answer(params, double(light->constant_attenuation), GetKind::real);
    case GL_LINEAR_ATTENUATION:
      return write_answer(params, double(light->linear_attenuation), GetKind::real);
    case GL_QUADRATIC_ATTENUATION:
      return write_answer(params, double(light->quadratic_attenuation), GetKind::real);
    default:
      return record_error(context, GL_INVALID_ENUM, operation);
  }
}

}  // namespace

namespace op {

void shade_model(Context& context, GLenum mode) {
  if (mode != GL_FLAT && mode != GL_SMOOTH) return record_error(context, GL_INVALID_ENUM);
  context.lighting.shade_model = mode;
  mark_dirty(context, kDirtyRaster);
}

void light(Context& context, GLenum light, GLenum pname, const GLfloat* params) {
  Light* target = find_light(context, light);
  if (!target) return record_error(context, GL_INVALID_ENUM);
  if (!is_light_value(pname, *params)) return record_error(context, GL_INVALID_VALUE);
  if (!set_light(context, *target, pname, params)) return record_error(context, GL_INVALID_ENUM);
  mark_dirty(context, kDirtyLighting);
}

void light_model(Context& context, GLenum pname, const GLfloat* params) {
  LightingState& lighting = context.lighting;
  switch (pname) {
    case GL_LIGHT_MODEL_AMBIENT:
      lighting.model_ambient = color_of(params);
      break;
    case GL_LIGHT_MODEL_LOCAL_VIEWER:
      lighting.local_viewer = *params != 0;
      break;
    case GL_LIGHT_MODEL_TWO_SIDE:
      lighting.two_side = *params != 0;
      break;
    default:
      return record_error(context, GL_INVALID_ENUM);
  }
  mark_dirty(context, kDirtyLighting);
}

void get_lightfv(Context& context, GLenum light, GLenum pname, GLfloat* params) {
  get_light(context, light, pname, params, __func__);
}

void get_lightiv(Context& context, GLenum light, GLenum pname, GLint* params) {
  get_light(context, light, pname, params, __func__);
}

}  // namespace op

std::span<const GetRow> lighting_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_SHADE_MODEL, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.lighting.shade_model; }},
      {GL_LIGHT_MODEL_AMBIENT, GetKind::normalized, 4,
       [](const Context& c, double* out) {
         const Color& color = c.lighting.model_ambient;
         const float components[] = {color.r, color.g, color.b, color.a};
         std::copy_n(components, 4, out);
       }},
      {GL_LIGHT_MODEL_LOCAL_VIEWER, GetKind::boolean, 1,
       [](const Context& c, double* out) { *out = c.lighting.local_viewer; }},
      {GL_LIGHT_MODEL_TWO_SIDE, GetKind::boolean, 1,
       [](const Context& c, double* out) { *out = c.lighting.two_side; }},
      {GL_COLOR_MATERIAL_FACE, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.lighting.color_material_face; }},
      {GL_COLOR_MATERIAL_PARAMETER, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.lighting.color_material_mode; }},
  };
  return kRows;
}

}  // namespace halfspace::state
