// Calls of every command of OpenGL 1.1, right and wrong: the refusals_*.inl as data.
#pragma once

#include <GL/gl.h>

#include <string>
#include <vector>

namespace halfspace::test {

inline constexpr GLenum kBad = 0xBAD0;

// What arguments point at.
struct Data {
  GLfloat f[64] = {}, minus_f[4] = {-1, -1, -1, -1};
  GLdouble d[64] = {};
  GLint i[64] = {}, minus_i[4] = {-1, -1, -1, -1};
  GLuint ui[64] = {}, one[1] = {1};
  GLshort s[64] = {};
  GLushort us[256] = {};
  GLubyte ub[1024] = {};
  GLboolean b[64] = {};
  GLvoid* p = nullptr;
};

inline void image_1d(Data& d) { glTexImage1D(GL_TEXTURE_1D, 0, 3, 4, 0, GL_RGB, GL_UNSIGNED_BYTE, d.ub); }
inline void image_2d(Data& d) { glTexImage2D(GL_TEXTURE_2D, 0, 3, 4, 2, 0, GL_RGB, GL_UNSIGNED_BYTE, d.ub); }

inline void repeat(int times, void (*call)()) {
  for (int i = 0; i < times; ++i) call();
}

using Call = void (*)(Data& d);

struct Case {
  const char* text;
  bool valid;
  GLenum error;
  Call setup, call;
  std::string command() const { return std::string(text).substr(0, std::string(text).find('(')); }
};

inline const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases = {
#define CASE(text, valid, error, setup, ...) \
  {text, valid, error, [](Data& d) { (void)d, (void)setup; }, [](Data& d) { (void)d, (void)(__VA_ARGS__); }},
#define VALID(...) CASE(#__VA_ARGS__, true, GL_NO_ERROR, 0, __VA_ARGS__)
#define VALID_AFTER(setup, ...) CASE(#__VA_ARGS__, true, GL_NO_ERROR, setup, __VA_ARGS__)
#define BAD(error, ...) CASE(#__VA_ARGS__, false, error, 0, __VA_ARGS__)
#define BAD_AFTER(error, setup, ...) CASE(#__VA_ARGS__, false, error, setup, __VA_ARGS__)
#include "tests/api/refusals_a_l.inl"
#include "tests/api/refusals_m_z.inl"
#undef CASE
#undef VALID
#undef VALID_AFTER
#undef BAD
#undef BAD_AFTER
  };
  return cases;
}

}  // namespace halfspace::test
