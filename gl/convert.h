// Arguments on their way to the operations: integers become floats here, once.
#pragma once

#include <GL/gl.h>

#include <array>
#include <cstddef>

namespace halfspace::gl {

// OpenGL 1.5 table 2.9: unsigned c / (2^n - 1), signed (2c + 1) / (2^n - 1). Operands up to 16 bits are exact
// in float, so one division rounds once; 32 bits are divided in double. The largest integer becomes
// exactly 1.
// Bytes, which programs that call once a vertex pass most, are looked up.
inline constexpr std::array<GLfloat, 256> kNormalizedBytes = [] {
  std::array<GLfloat, 256> table{};
  for (size_t c = 0; c < table.size(); ++c) table[c] = static_cast<GLfloat>(c) / 255.0f;
  return table;
}();
inline GLfloat normalized(GLubyte c) { return kNormalizedBytes[c]; }
inline GLfloat normalized(GLushort c) { return static_cast<GLfloat>(c) / 65535.0f; }
inline GLfloat normalized(GLbyte c) { return static_cast<GLfloat>(2 * c + 1) / 255.0f; }
inline GLfloat normalized(GLshort c) { return static_cast<GLfloat>(2 * c + 1) / 65535.0f; }
inline GLfloat normalized(GLuint c) { return static_cast<GLfloat>(c / 4294967295.0); }
inline GLfloat normalized(GLint c) { return static_cast<GLfloat>((2.0 * c + 1.0) / 4294967295.0); }

// A vector of another element type.
template <typename To, size_t kCount, typename From>
std::array<To, kCount> converted(const From* v) {
  std::array<To, kCount> result;
  for (size_t i = 0; i < kCount; ++i) result[i] = static_cast<To>(v[i]);
  return result;
}

// The scalar forms take no pname that stands for a vector (spec 2.14.2, 3.8.4, 3.8.13): such a name becomes
// 0, which no operation knows, and is refused like any other unknown name.
template <GLenum... kVectorNames>
GLenum scalar_pname(GLenum pname) {
  return ((pname == kVectorNames) || ...) ? GLenum{0} : pname;
}

// glLightiv: colours are normalised, positions and the rest are not (spec 2.14.1). Like material_floats.
inline std::array<GLfloat, 4> light_floats(GLenum pname, const GLint* params) {
  std::array<GLfloat, 4> v{};
  switch (pname) {
    case GL_AMBIENT:
    case GL_DIFFUSE:
    case GL_SPECULAR:
      for (size_t i = 0; i < 4; ++i) v[i] = normalized(params[i]);
      break;
    case GL_POSITION:
      for (size_t i = 0; i < 4; ++i) v[i] = static_cast<GLfloat>(params[i]);
      break;
    case GL_SPOT_DIRECTION:
      for (size_t i = 0; i < 3; ++i) v[i] = static_cast<GLfloat>(params[i]);
      break;
    case GL_SPOT_EXPONENT:
    case GL_SPOT_CUTOFF:
    case GL_CONSTANT_ATTENUATION:
    case GL_LINEAR_ATTENUATION:
    case GL_QUADRATIC_ATTENUATION:
      v[0] = static_cast<GLfloat>(params[0]);
      break;
    default:
      break;
  }
  return v;
}

// glLightModeliv, likewise.
inline std::array<GLfloat, 4> light_model_floats(GLenum pname, const GLint* params) {
  std::array<GLfloat, 4> v{};
  if (pname == GL_LIGHT_MODEL_AMBIENT) {
    for (size_t i = 0; i < 4; ++i) v[i] = normalized(params[i]);
  } else if (pname == GL_LIGHT_MODEL_LOCAL_VIEWER || pname == GL_LIGHT_MODEL_TWO_SIDE) {
    v[0] = static_cast<GLfloat>(params[0]);
  }
  return v;
}

// glTexGen{i,f}v: a plane has four values, a mode one.
template <typename From>
std::array<GLdouble, 4> tex_gen_doubles(GLenum pname, const From* params) {
  const bool plane = pname == GL_OBJECT_PLANE || pname == GL_EYE_PLANE;
  const size_t count = plane ? 4 : pname == GL_TEXTURE_GEN_MODE ? 1 : 0;
  std::array<GLdouble, 4> v{};
  for (size_t i = 0; i < count; ++i) v[i] = static_cast<GLdouble>(params[i]);
  return v;
}

// glFogiv: the colour is normalised, the rest is not (spec 3.10). Likewise.
inline std::array<GLfloat, 4> fog_floats(GLenum pname, const GLint* params) {
  std::array<GLfloat, 4> v{};
  switch (pname) {
    case GL_FOG_COLOR:
      for (size_t i = 0; i < 4; ++i) v[i] = normalized(params[i]);
      break;
    case GL_FOG_MODE:
    case GL_FOG_DENSITY:
    case GL_FOG_START:
    case GL_FOG_END:
    case GL_FOG_INDEX:
      v[0] = static_cast<GLfloat>(params[0]);
      break;
    default:
      break;
  }
  return v;
}

// glMaterialiv: colours are normalised, shininess and colour indices are not (spec 2.14.2). Reads as many
// values as the pname has, and none for a pname that is none.
inline std::array<GLfloat, 4> material_floats(GLenum pname, const GLint* params) {
  std::array<GLfloat, 4> v{};
  switch (pname) {
    case GL_AMBIENT:
    case GL_DIFFUSE:
    case GL_SPECULAR:
    case GL_EMISSION:
    case GL_AMBIENT_AND_DIFFUSE:
      for (size_t i = 0; i < 4; ++i) v[i] = normalized(params[i]);
      break;
    case GL_COLOR_INDEXES:
      for (size_t i = 0; i < 3; ++i) v[i] = static_cast<GLfloat>(params[i]);
      break;
    case GL_SHININESS:
      v[0] = static_cast<GLfloat>(params[0]);
      break;
    default:
      break;
  }
  return v;
}

}  // namespace halfspace::gl
