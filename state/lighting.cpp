#include "state/lighting.h"

#include <algorithm>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace {

bool is_material_name(GLenum pname) {
  switch (pname) {
    case GL_AMBIENT:
    case GL_DIFFUSE:
    case GL_SPECULAR:
    case GL_EMISSION:
    case GL_SHININESS:
    case GL_AMBIENT_AND_DIFFUSE:
    case GL_COLOR_INDEXES:
      return true;
    default:
      return false;
  }
}

void set_material(MaterialState& material, GLenum pname, const GLfloat* params) {
  switch (pname) {
    case GL_AMBIENT:
      std::copy_n(params, 4, material.ambient);
      break;
    case GL_DIFFUSE:
      std::copy_n(params, 4, material.diffuse);
      break;
    case GL_AMBIENT_AND_DIFFUSE:
      std::copy_n(params, 4, material.ambient);
      std::copy_n(params, 4, material.diffuse);
      break;
    case GL_SPECULAR:
      std::copy_n(params, 4, material.specular);
      break;
    case GL_EMISSION:
      std::copy_n(params, 4, material.emission);
      break;
    case GL_SHININESS:
      material.shininess = *params;
      break;
    default:
      std::copy_n(params, 3, material.color_indexes);
      break;
  }
}

}  // namespace

namespace op {

void shade_model(Context& context, GLenum mode) {
  if (mode != GL_FLAT && mode != GL_SMOOTH) return record_error(context, GL_INVALID_ENUM);
  context.lighting.shade_model = mode;
  mark_dirty(context, kDirtyRaster);
}

void material(Context& context, GLenum face, GLenum pname, const GLfloat* params) {
  const bool known_face = face == GL_FRONT || face == GL_BACK || face == GL_FRONT_AND_BACK;
  if (!known_face || !is_material_name(pname)) return record_error(context, GL_INVALID_ENUM);
  if (pname == GL_SHININESS && !(*params >= 0 && *params <= 128))
    return record_error(context, GL_INVALID_VALUE);
  if (face != GL_BACK) set_material(context.lighting.material[0], pname, params);
  if (face != GL_FRONT) set_material(context.lighting.material[1], pname, params);
}

}  // namespace op

std::span<const GetRow> lighting_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_SHADE_MODEL, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.lighting.shade_model; }},
  };
  return kRows;
}

}  // namespace halfspace::state
