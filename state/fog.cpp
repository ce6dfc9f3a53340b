#include "state/fog.h"

#include <algorithm>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace {

float clamp_unit(float v) { return v > 0 ? std::min(v, 1.0f) : 0.0f; }  // NaN becomes 0

// `value` as a program that has floats only says it; any float, not just an enumerant.
void set_mode(Context& context, GLfloat value) {
  for (const GLint mode : {GL_LINEAR, GL_EXP, GL_EXP2}) {
    if (value != GLfloat(mode)) continue;
    context.fog.mode = GLenum(mode);
    return;
  }
  record_error(context, GL_INVALID_ENUM, "fog");
}

}  // namespace

raster::FogState derive_fog(const Context& context) {
  const FogState& fog = context.fog;
  raster::FogState out;
  out.enabled = fog.enabled;
  out.mode = fog.mode == GL_LINEAR ? raster::FogMode::linear
             : fog.mode == GL_EXP2 ? raster::FogMode::exp2
                                   : raster::FogMode::exp;
  out.color = fog.color;
  out.density = fog.density;
  out.start = fog.start;
  out.end = fog.end;
  return out;
}

namespace op {

void fog(Context& context, GLenum pname, const GLfloat* params) {
  FogState& fog = context.fog;
  switch (pname) {
    case GL_FOG_MODE:
      set_mode(context, params[0]);
      break;
    case GL_FOG_DENSITY:
      if (!(params[0] >= 0)) return record_error(context, GL_INVALID_VALUE);
      fog.density = params[0];
      break;
    case GL_FOG_START:
      fog.start = params[0];
      break;
    case GL_FOG_END:
      fog.end = params[0];
      break;
    case GL_FOG_INDEX:
      fog.index = params[0];
      break;
    case GL_FOG_COLOR:
      fog.color = {clamp_unit(params[0]), clamp_unit(params[1]), clamp_unit(params[2]),
                   clamp_unit(params[3])};
      break;
    default:
      return record_error(context, GL_INVALID_ENUM);
  }
  mark_dirty(context, kDirtyFragment);
}

}  // namespace op

std::span<const GetRow> fog_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_FOG_MODE, GetKind::enumeration, 1, [](const Context& c, double* out) { *out = c.fog.mode; }},
      {GL_FOG_DENSITY, GetKind::real, 1, [](const Context& c, double* out) { *out = double(c.fog.density); }},
      {GL_FOG_START, GetKind::real, 1, [](const Context& c, double* out) { *out = double(c.fog.start); }},
      {GL_FOG_END, GetKind::real, 1, [](const Context& c, double* out) { *out = double(c.fog.end); }},
      {GL_FOG_INDEX, GetKind::real, 1, [](const Context& c, double* out) { *out = double(c.fog.index); }},
      {GL_FOG_COLOR, GetKind::normalized, 4,
       [](const Context& c, double* out) {
         const raster::Color& color = c.fog.color;
         out[0] = double(color.r);
         out[1] = double(color.g);
         out[2] = double(color.b);
         out[3] = double(color.a);
       }},
  };
  return kRows;
}

}  // namespace halfspace::state
