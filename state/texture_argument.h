// Arguments and answers of glTexParameter and glTexEnv, which come as floats or as integers.
#pragma once

#include "raster/api/types.h"
#include "state/get.h"
#include "state/gl_types.h"
#include "state/pixel_value.h"

namespace halfspace::state {

// A name passed as a number; 0, which no parameter takes, when it can be none.
inline GLenum enum_argument(GLint v) { return GLenum(v); }
inline GLenum enum_argument(GLfloat v) { return v >= 0 && v < 2147483648.0f ? GLenum(v) : 0; }

// One component of a colour, clamped to [0, 1]; integers stand for (2c + 1) / (2^32 - 1) (table 2.9).
inline float color_component(GLfloat v) { return clamp_unit(v); }
inline float color_component(GLint v) { return clamp_unit(float((2.0 * v + 1) / 4294967295.0)); }

template <class T>
raster::Color color_argument(const T* v) {
  return {color_component(v[0]), color_component(v[1]), color_component(v[2]), color_component(v[3])};
}

inline void write_answer(GLfloat* out, double value, GetKind) { *out = to_float(value); }
inline void write_answer(GLint* out, double value, GetKind kind) { *out = to_integer(value, kind); }

template <class T>
void write_color_answer(T* out, const raster::Color& color) {
  const float components[4] = {color.r, color.g, color.b, color.a};
  for (int i = 0; i < 4; ++i) write_answer(out + i, double(components[i]), GetKind::normalized);
}

}  // namespace halfspace::state
