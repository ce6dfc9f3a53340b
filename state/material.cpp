// glMaterial, glColorMaterial (spec 2.14.2, 2.14.3).
#include <algorithm>
#include <cstring>
#include <new>

#include "state/context.h"
#include "state/operations.gen.h"
#include "state/texture_argument.h"

namespace halfspace::state {
namespace {

enum PropertyBits : unsigned {
  kAmbient = 1,
  kDiffuse = 2,
  kSpecular = 4,
  kEmission = 8,
  kShininess = 16,
  kColorIndexes = 32,
};

// What `pname` sets; 0: it is none of a material.
unsigned properties_of(GLenum pname) {
  switch (pname) {
    case GL_AMBIENT:
      return kAmbient;
    case GL_DIFFUSE:
      return kDiffuse;
    case GL_AMBIENT_AND_DIFFUSE:
      return kAmbient | kDiffuse;
    case GL_SPECULAR:
      return kSpecular;
    case GL_EMISSION:
      return kEmission;
    case GL_SHININESS:
      return kShininess;
    case GL_COLOR_INDEXES:
      return kColorIndexes;
    default:
      return 0;
  }
}

bool is_face(GLenum face) { return face == GL_FRONT || face == GL_BACK || face == GL_FRONT_AND_BACK; }
bool has_face(GLenum face, int side) { return face != (side == 0 ? GL_BACK : GL_FRONT); }

// Properties of a side that are the current colour now.
unsigned tracked(const LightingState& lighting, int side) {
  const bool on = lighting.color_material && has_face(lighting.color_material_face, side);
  return on ? properties_of(lighting.color_material_mode) : 0;
}

void set_material(MaterialState& material, unsigned properties, const GLfloat* params) {
  if (properties & kAmbient) std::copy_n(params, 4, material.ambient);
  if (properties & kDiffuse) std::copy_n(params, 4, material.diffuse);
  if (properties & kSpecular) std::copy_n(params, 4, material.specular);
  if (properties & kEmission) std::copy_n(params, 4, material.emission);
  if (properties & kShininess) material.shininess = *params;
  if (properties & kColorIndexes) std::copy_n(params, 3, material.color_indexes);
}

raster::Color color_of(const float (&v)[4]) { return {v[0], v[1], v[2], v[3]}; }

raster::Material material_of(const MaterialState& m) {
  return {color_of(m.ambient), color_of(m.diffuse), color_of(m.specular), color_of(m.emission), m.shininess};
}

template <class T>
void get_material(Context& context, GLenum face, GLenum pname, T* params, const char* operation) {
  if (face != GL_FRONT && face != GL_BACK) return record_error(context, GL_INVALID_ENUM, operation);
  settle_color_material(context);
  const MaterialState& material = context.lighting.material[face == GL_BACK];
  switch (pname) {
    case GL_AMBIENT:
      return write_color_answer(params, color_of(material.ambient));
    case GL_DIFFUSE:
      return write_color_answer(params, color_of(material.diffuse));
    case GL_SPECULAR:
      return write_color_answer(params, color_of(material.specular));
    case GL_EMISSION:
      return write_color_answer(params, color_of(material.emission));
    case GL_SHININESS:
      return write_answer(params, double(material.shininess), GetKind::real);
    case GL_COLOR_INDEXES:
      for (int i = 0; i < 3; ++i) write_answer(params + i, double(material.color_indexes[i]), GetKind::real);
      return;
    default:
      return record_error(context, GL_INVALID_ENUM, operation);
  }
}

}  // namespace

void settle_color_material(Context& context) {
  LightingState& lighting = context.lighting;
  if (!lighting.color_material) return;
  for (int side = 0; side < 2; ++side) {
    set_material(lighting.material[side], tracked(lighting, side), context.current.color);
  }
  mark_dirty(context, kDirtyLighting);
}

raster::MaterialPair material_pair(const LightingState& lighting) {
  return {material_of(lighting.material[0]), material_of(lighting.material[1])};
}

namespace op {

void material(Context& context, GLenum face, GLenum pname, const GLfloat* params) try {
  const unsigned properties = properties_of(pname);
  if (!is_face(face) || properties == 0) return record_error(context, GL_INVALID_ENUM);
  if (pname == GL_SHININESS && !(*params >= 0 && *params <= 128))
    return record_error(context, GL_INVALID_VALUE);
  LightingState& lighting = context.lighting;
  bool changed = false;
  for (int side = 0; side < 2; ++side) {
    if (!has_face(face, side)) continue;
    const MaterialState before = lighting.material[side];
    set_material(lighting.material[side], properties & ~tracked(lighting, side), params);
    changed |= std::memcmp(&before, &lighting.material[side], sizeof before) != 0;
  }
  if (!changed) return;
  mark_dirty(context, kDirtyLighting);
  gather_material(context, material_pair(lighting));
} catch (const std::bad_alloc&) {
  record_error(context, GL_OUT_OF_MEMORY, "material");
}

void color_material(Context& context, GLenum face, GLenum mode) {
  const unsigned properties = properties_of(mode);
  if (!is_face(face) || properties == 0 || properties >= kShininess)
    return record_error(context, GL_INVALID_ENUM);
  settle_color_material(context);
  context.lighting.color_material_face = face;
  context.lighting.color_material_mode = mode;
  mark_dirty(context, kDirtyLighting);
}

void get_materialfv(Context& context, GLenum face, GLenum pname, GLfloat* params) {
  get_material(context, face, pname, params, __func__);
}

void get_materialiv(Context& context, GLenum face, GLenum pname, GLint* params) {
  get_material(context, face, pname, params, __func__);
}

}  // namespace op
}  // namespace halfspace::state
