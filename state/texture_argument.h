// Arguments and answers of glTexParameter, glTexEnv and their like, which come as floats or as integers.
#pragma once

#include "raster/api/types.h"
#include "state/error.h"
#include "state/get.h"
#include "state/gl_types.h"
#include "state/pixel_value.h"

namespace halfspace::state {

// A name passed as a number; 0, which no parameter takes, when it can be none.
inline GLenum enum_argument(GLint v) { return GLenum(v); }
inline GLenum enum_argument(GLfloat v) { return v >= 0 && v < 2147483648.0f ? GLenum(v) : 0; }

// A number in [0, 1], such as a component of a colour, clamped; integers stand for (2c + 1) / (2^32 - 1)
// (table 2.9).
inline float unit_argument(GLfloat v) { return clamp_unit(v); }
inline float unit_argument(GLint v) { return clamp_unit(float((2.0 * v + 1) / 4294967295.0)); }

template <class T>
raster::Color color_argument(const T* v) {
  return {unit_argument(v[0]), unit_argument(v[1]), unit_argument(v[2]), unit_argument(v[3])};
}

// What a query of a parameter yields: `count` values of one kind, or the error there is instead.
struct Answer {
  GLenum error = GL_NO_ERROR;
  GetKind kind = GetKind::enumeration;
  int count = 1;
  double values[4] = {};
};

inline Answer refusal(GLenum error) { return {.error = error, .count = 0}; }
inline Answer scalar_answer(GetKind kind, double value) { return {.kind = kind, .values = {value}}; }
inline Answer color_answer(const raster::Color& c) {
  return {.kind = GetKind::normalized,
          .count = 4,
          .values = {double(c.r), double(c.g), double(c.b), double(c.a)}};
}

inline void write_answer(GLfloat* out, double value, GetKind) { *out = to_float(value); }
inline void write_answer(GLint* out, double value, GetKind kind) { *out = to_integer(value, kind); }

template <class T>
void write_color_answer(T* out, const raster::Color& color) {
  const Answer answer = color_answer(color);
  for (int i = 0; i < answer.count; ++i) write_answer(out + i, answer.values[i], answer.kind);
}

// Ends a query: the values in the type that was asked for, or the error.
template <class T>
void give_answer(Context& context, const Answer& answer, T* params,
                 const char* operation = __builtin_FUNCTION()) {
  if (answer.error != GL_NO_ERROR) return record_error(context, answer.error, operation);
  for (int i = 0; i < answer.count; ++i) write_answer(params + i, answer.values[i], answer.kind);
}

}  // namespace halfspace::state
