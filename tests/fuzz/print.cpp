// Streams as C.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "call.h"

namespace halfspace::fuzz {
namespace {

template <typename Number>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<Number, GLbyte>)
    return "GLbyte";
  else if constexpr (std::is_same_v<Number, GLshort>)
    return "GLshort";
  else if constexpr (std::is_same_v<Number, GLushort>)
    return "GLushort";
  else if constexpr (std::is_same_v<Number, GLint>)
    return "GLint";
  else if constexpr (std::is_same_v<Number, GLuint>)
    return "GLuint";
  else if constexpr (std::is_same_v<Number, GLfloat>)
    return "GLfloat";
  else if constexpr (std::is_same_v<Number, GLdouble>)
    return "GLdouble";
  else
    return "GLubyte";
}

std::string number(double value, bool is_float) {
  char text[64];
  if (value == std::trunc(value) && std::fabs(value) < 1e15) {
    std::snprintf(text, sizeof(text), "%.0f", value);
  } else {
    std::snprintf(text, sizeof(text), is_float ? "%.9g" : "%.17g", value);
    if (is_float) std::strcat(text, "f");
  }
  return text;
}

template <typename Element>
std::string literal(const std::vector<uint8_t>& data) {
  std::string text = "(const " + std::string(type_name<Element>()) + "[]){";
  for (size_t at = 0; at + sizeof(Element) <= data.size(); at += sizeof(Element)) {
    Element element;
    std::memcpy(&element, data.data() + at, sizeof(element));
    if (at > 0) text += at / sizeof(Element) % 24 ? "," : ",\n    ";
    text += number(static_cast<double>(element), std::is_same_v<Element, GLfloat>);
  }
  return text + "}";
}

struct Value {
  GLenum value;
  const char* name;
  const char* groups;
};

const Value kValues[] = {
#define HALFSPACE_VALUE(name, groups) {static_cast<GLenum>(name), #name, groups},
#include "values.gen.def"
#undef HALFSPACE_VALUE
};

std::string hexadecimal(GLenum value) {
  char text[32];
  std::snprintf(text, sizeof(text), "0x%X", value);
  return text;
}

std::string value_name(double argument, const std::string& group) {
  const auto value = static_cast<GLenum>(argument);
  const std::string wanted = "," + group + ",";
  const char* other = nullptr;
  for (const Value& row : kValues) {
    if (row.value != value) continue;
    if (!group.empty() && std::strstr(row.groups, wanted.c_str())) return row.name;
    other = row.name;
  }
  // Small numbers have many names.
  return other && value >= 0x200 ? other : hexadecimal(value);
}

std::string bits(double argument, const std::string& group) {
  auto left = static_cast<GLenum>(argument);
  const std::string wanted = "," + group + ",";
  std::string text;
  for (const Value& row : kValues) {
    if (row.value == 0 || (row.value & left) != row.value || (row.value & (row.value - 1)) != 0) continue;
    if (!std::strstr(row.groups, wanted.c_str())) continue;
    text += (text.empty() ? "" : " | ") + std::string(row.name);
    left &= ~row.value;
  }
  if (left || text.empty()) text += (text.empty() ? "" : " | ") + hexadecimal(left);
  return text;
}

std::vector<std::string> split(const char* groups) {
  std::vector<std::string> parts(1);
  for (const char* c = groups; *c; ++c) {
    if (*c == ',')
      parts.emplace_back();
    else
      parts.back() += *c;
  }
  return parts;
}

template <typename Parameter>
std::string argument(const Call& call, size_t index, const std::string& group) {
  const double value = call.arguments[index];
  if constexpr (std::is_pointer_v<Parameter>) {
    if (call.data.empty()) return "NULL";
    using Element = std::remove_pointer_t<Parameter>;
    if constexpr (!std::is_const_v<Element>)
      return "(" + std::string(type_name<Element>()) + "[" +
             std::to_string(call.data.size() / sizeof(Element)) + "]){0}";
    return literal<std::remove_cv_t<std::conditional_t<std::is_void_v<std::remove_pointer_t<Parameter>>,
                                                       GLubyte, std::remove_pointer_t<Parameter>>>>(
        call.data);
  } else if constexpr (std::is_same_v<Parameter, GLenum>) {
    if (group.ends_with("Mask")) return bits(value, group);
    // GLuint and GLenum are the same type to C++.
    return group.empty() || group == "List" || group == "Texture" ? number(value, false)
                                                                  : value_name(value, group);
  } else if constexpr (std::is_same_v<Parameter, GLint>) {
    return value >= 0x500 && group != "" ? value_name(value, group) : number(value, false);
  } else {
    return number(value, std::is_same_v<Parameter, GLfloat>);
  }
}

template <typename Function>
struct Printer;

template <typename Result, typename... Parameters>
struct Printer<Result(Parameters...)> {
  static std::string print(const Call& call, const char* groups) {
    return print_indexed(call, split(groups), std::index_sequence_for<Parameters...>());
  }
  template <size_t... kIndices>
  static std::string print_indexed([[maybe_unused]] const Call& call,
                                   [[maybe_unused]] const std::vector<std::string>& groups,
                                   std::index_sequence<kIndices...>) {
    std::string text = std::string(name_of(call.command)) + "(";
    ((text += (kIndices ? ", " : "") + argument<Parameters>(call, kIndices, groups[kIndices])), ...);
    return text + ");";
  }
};

using Print = std::string (*)(const Call&, const char*);
struct Row {
  Print print;
  const char* groups;
};

const Row kRows[] = {
#define HALFSPACE_COMMAND(name, groups) {Printer<decltype(::name)>::print, groups},
#include "commands.gen.def"
#undef HALFSPACE_COMMAND
};

constexpr const char* kProgramStart = R"(// cc -o stream stream.c -lOSMesa && ./stream > picture.ppm
#include <GL/gl.h>
#include <GL/osmesa.h>
#include <stdio.h>
#include <stdlib.h>

static void draw(void) {
)";

constexpr const char* kProgramEnd = R"(}

int main(void) {
  unsigned char* pixels = calloc(kWidth * kHeight, 4);
  OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 24, 8, 16, NULL);
  if (!context || !OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, kWidth, kHeight)) return 1;
  fprintf(stderr, "%s\n", (const char*)glGetString(GL_RENDERER));
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT | GL_ACCUM_BUFFER_BIT);
  draw();
  for (GLenum error; (error = glGetError());) fprintf(stderr, "error 0x%x\n", error);
  glFinish();
  printf("P6 %d %d 255\n", kWidth, kHeight);
  for (int y = kHeight - 1; y >= 0; --y)
    for (int x = 0; x < kWidth; ++x) fwrite(pixels + 4 * (y * kWidth + x), 1, 3, stdout);
  OSMesaDestroyContext(context);
  free(pixels);
  return 0;
}
)";

}  // namespace

std::string print_call(const Call& call) {
  const Row& row = kRows[static_cast<size_t>(call.command)];
  return row.print(call, row.groups);
}

std::string print_program(const Stream& stream, int width, int height) {
  std::string text = kProgramStart;
  for (const Call& call : stream) text += "  " + print_call(call) + "\n";
  text += kProgramEnd;
  const std::string sizes =
      "enum { kWidth = " + std::to_string(width) + ", kHeight = " + std::to_string(height) + " };\n\n";
  return text.insert(text.find("static void draw"), sizes);
}

}  // namespace halfspace::fuzz
