#include "state/tex_gen.h"

#include <algorithm>
#include <type_traits>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"
#include "state/texture_argument.h"

namespace halfspace::state {
namespace {

TexGenCoordState* find_coord(Context& context, GLenum name) {
  const GLenum index = name - GL_S;
  return index < 4 ? &context.tex_gen.coord[index] : nullptr;
}

bool is_mode(GLenum coord, GLenum mode) {
  const bool sphere = mode == GL_SPHERE_MAP && (coord == GL_S || coord == GL_T);
  return mode == GL_OBJECT_LINEAR || mode == GL_EYE_LINEAR || sphere;
}

std::array<double, 4> plane_of(const GLdouble* v) { return {v[0], v[1], v[2], v[3]}; }

template <class T>
void write_plane(T* out, const std::array<double, 4>& plane) {
  for (size_t i = 0; i < 4; ++i) {
    if constexpr (std::is_same_v<T, GLdouble>)
      out[i] = plane[i];
    else
      write_answer(out + i, plane[i], GetKind::real);
  }
}

template <class T>
void get_tex_gen(Context& context, GLenum name, GLenum pname, T* params, const char* operation) {
  const TexGenCoordState* coord = find_coord(context, name);
  if (!coord) return record_error(context, GL_INVALID_ENUM, operation);
  switch (pname) {
    case GL_TEXTURE_GEN_MODE:
      *params = T(coord->mode);
      return;
    case GL_OBJECT_PLANE:
      return write_plane(params, coord->object_plane);
    case GL_EYE_PLANE:
      return write_plane(params, coord->eye_plane);
    default:
      return record_error(context, GL_INVALID_ENUM, operation);
  }
}

raster::TexGenMode mode_of(const TexGenCoordState& coord) {
  if (!coord.enabled) return raster::TexGenMode::off;
  switch (coord.mode) {
    case GL_OBJECT_LINEAR:
      return raster::TexGenMode::object_linear;
    case GL_EYE_LINEAR:
      return raster::TexGenMode::eye_linear;
    default:
      return raster::TexGenMode::sphere_map;
  }
}

}  // namespace

raster::TexGenState derive_tex_gen(const TexGenState& state) {
  raster::TexGenState out;
  for (size_t i = 0; i < 4; ++i) {
    const TexGenCoordState& coord = state.coord[i];
    out.coord[i] = {mode_of(coord), coord.object_plane, coord.eye_plane};
  }
  return out;
}

namespace op {

void tex_gen(Context& context, GLenum coord, GLenum pname, const GLdouble* params) {
  TexGenCoordState* target = find_coord(context, coord);
  if (!target) return record_error(context, GL_INVALID_ENUM);
  switch (pname) {
    case GL_TEXTURE_GEN_MODE: {
      const GLenum mode = *params >= 0 && *params < 2147483648.0 ? GLenum(*params) : 0;
      if (!is_mode(coord, mode)) return record_error(context, GL_INVALID_ENUM);
      target->mode = mode;
      break;
    }
    case GL_OBJECT_PLANE:
      target->object_plane = plane_of(params);
      break;
    case GL_EYE_PLANE:
      target->eye_plane = eye_plane(context.transform.modelview.top(), params);
      break;
    default:
      return record_error(context, GL_INVALID_ENUM);
  }
  mark_dirty(context, kDirtyTexCoords | kDirtyTransform);
}

void get_tex_genfv(Context& context, GLenum coord, GLenum pname, GLfloat* params) {
  get_tex_gen(context, coord, pname, params, __func__);
}

void get_tex_geniv(Context& context, GLenum coord, GLenum pname, GLint* params) {
  get_tex_gen(context, coord, pname, params, __func__);
}

void get_tex_gendv(Context& context, GLenum coord, GLenum pname, GLdouble* params) {
  get_tex_gen(context, coord, pname, params, __func__);
}

}  // namespace op
}  // namespace halfspace::state
