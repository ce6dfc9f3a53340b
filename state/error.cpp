#include "state/error.h"

#include <cstdarg>
#include <cstdio>
#include <cstdlib>

#include "state/context.h"
#include "state/operations.gen.h"
#include "state/report.h"

namespace halfspace::state {
namespace {

bool debug_requested() {
  static const bool requested = [] {
    const char* value = std::getenv("HALFSPACE_DEBUG");
    return value && *value && *value != '0';
  }();
  return requested;
}

const char* error_text(GLenum code) {
  switch (code) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_STACK_OVERFLOW:
      return "GL_STACK_OVERFLOW";
    case GL_STACK_UNDERFLOW:
      return "GL_STACK_UNDERFLOW";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    default:
      return "an error";
  }
}

}  // namespace

void report(const char* format, ...) {
  // One write, so that the lines of several threads do not mix.
  char line[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  std::fprintf(stderr, "halfspace: %s\n", line);
}

void record_error(Context& context, GLenum code, const char* operation) {
  if (context.error.code == GL_NO_ERROR) context.error.code = code;
  if (debug_requested()) report("%s in %s", error_text(code), operation);
}

namespace op {

GLenum get_error(Context& context) {
  const GLenum code = context.error.code;
  context.error.code = GL_NO_ERROR;
  return code;
}

}  // namespace op
}  // namespace halfspace::state
