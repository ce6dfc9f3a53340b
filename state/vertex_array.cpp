#include "state/vertex_array.h"

#include <algorithm>
#include <utility>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {

ClientArray* find_client_array(VertexArrayState& arrays, GLenum name) {
  switch (name) {
    case GL_VERTEX_ARRAY:
      return &arrays.vertex;
    case GL_COLOR_ARRAY:
      return &arrays.color;
    case GL_TEXTURE_COORD_ARRAY:
      return &arrays.tex_coord;
    case GL_NORMAL_ARRAY:
      return &arrays.normal;
    case GL_EDGE_FLAG_ARRAY:
      return &arrays.edge_flag;
    case GL_INDEX_ARRAY:
      return &arrays.index;
    default:
      return nullptr;
  }
}

namespace {

bool one_of(GLenum value, std::initializer_list<GLenum> list) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

// Validates by spec table 2.4, then takes the new array over.
void set_pointer(Context& context, ClientArray& array, bool size_known, bool type_known,
                 const ClientArray& value, const char* operation) {
  if (!size_known || value.stride < 0) return record_error(context, GL_INVALID_VALUE, operation);
  if (!type_known) return record_error(context, GL_INVALID_ENUM, operation);
  const bool enabled = array.enabled;
  array = value;
  array.enabled = enabled;
}

// GL_EXT_vertex_array: `set` is the command without a count; what it refuses leaves the array as it was.
template <class Set>
void set_pointer_and_count(Context& context, ClientArray& array, GLsizei count, const char* operation,
                           Set&& set) {
  if (count < 0) return record_error(context, GL_INVALID_VALUE, operation);
  const GLenum pending = std::exchange(context.error.code, GL_NO_ERROR);
  set();
  if (context.error.code == GL_NO_ERROR) array.count = count;
  if (pending != GL_NO_ERROR) context.error.code = pending;
}

// Spec table 2.5: what an interleaved format holds, and where, in bytes.
struct InterleavedFormat {
  GLenum name;
  GLint tex_coord_size;  // 0: none
  GLint color_size;      // 0: none
  GLenum color_type;
  bool normal;
  GLint vertex_size;
  GLsizei color_offset, normal_offset, vertex_offset, stride;
};

constexpr InterleavedFormat kInterleavedFormats[] = {
    {GL_V2F, 0, 0, 0, false, 2, 0, 0, 0, 8},
    {GL_V3F, 0, 0, 0, false, 3, 0, 0, 0, 12},
    {GL_C4UB_V2F, 0, 4, GL_UNSIGNED_BYTE, false, 2, 0, 0, 4, 12},
    {GL_C4UB_V3F, 0, 4, GL_UNSIGNED_BYTE, false, 3, 0, 0, 4, 16},
    {GL_C3F_V3F, 0, 3, GL_FLOAT, false, 3, 0, 0, 12, 24},
    {GL_N3F_V3F, 0, 0, 0, true, 3, 0, 0, 12, 24},
    {GL_C4F_N3F_V3F, 0, 4, GL_FLOAT, true, 3, 0, 16, 28, 40},
    {GL_T2F_V3F, 2, 0, 0, false, 3, 0, 0, 8, 20},
    {GL_T4F_V4F, 4, 0, 0, false, 4, 0, 0, 16, 32},
    {GL_T2F_C4UB_V3F, 2, 4, GL_UNSIGNED_BYTE, false, 3, 8, 0, 12, 24},
    {GL_T2F_C3F_V3F, 2, 3, GL_FLOAT, false, 3, 8, 0, 20, 32},
    {GL_T2F_N3F_V3F, 2, 0, 0, true, 3, 0, 8, 20, 32},
    {GL_T2F_C4F_N3F_V3F, 2, 4, GL_FLOAT, true, 3, 8, 24, 36, 48},
    {GL_T4F_C4F_N3F_V4F, 4, 4, GL_FLOAT, true, 4, 16, 32, 44, 60},
};

ClientArray interleaved_array(bool enabled, GLint size, GLenum type, GLsizei stride, const void* pointer,
                              GLsizei offset) {
  return {enabled, size, type, stride, static_cast<const char*>(pointer) + offset};
}

void set_client_state(Context& context, GLenum name, bool on, const char* operation) {
  ClientArray* array = find_client_array(context.vertex_array, name);
  if (!array) return record_error(context, GL_INVALID_ENUM, operation);
  array->enabled = on;
}

}  // namespace

namespace op {

void vertex_pointer(Context& context, GLint size, GLenum type, GLsizei stride, const GLvoid* pointer) {
  set_pointer(context, context.vertex_array.vertex, size >= 2 && size <= 4,
              one_of(type, {GL_SHORT, GL_INT, GL_FLOAT, GL_DOUBLE}), {false, size, type, stride, pointer},
              "vertex_pointer");
}

void color_pointer(Context& context, GLint size, GLenum type, GLsizei stride, const GLvoid* pointer) {
  set_pointer(context, context.vertex_array.color, size == 3 || size == 4,
              one_of(type, {GL_BYTE, GL_UNSIGNED_BYTE, GL_SHORT, GL_UNSIGNED_SHORT, GL_INT, GL_UNSIGNED_INT,
                            GL_FLOAT, GL_DOUBLE}),
              {false, size, type, stride, pointer}, "color_pointer");
}

void normal_pointer(Context& context, GLenum type, GLsizei stride, const GLvoid* pointer) {
  set_pointer(context, context.vertex_array.normal, true,
              one_of(type, {GL_BYTE, GL_SHORT, GL_INT, GL_FLOAT, GL_DOUBLE}),
              {false, 3, type, stride, pointer}, "normal_pointer");
}

void tex_coord_pointer(Context& context, GLint size, GLenum type, GLsizei stride, const GLvoid* pointer) {
  set_pointer(context, context.vertex_array.tex_coord, size >= 1 && size <= 4,
              one_of(type, {GL_SHORT, GL_INT, GL_FLOAT, GL_DOUBLE}), {false, size, type, stride, pointer},
              "tex_coord_pointer");
}

void edge_flag_pointer(Context& context, GLsizei stride, const GLvoid* pointer) {
  set_pointer(context, context.vertex_array.edge_flag, true, true,
              {false, 1, GL_UNSIGNED_BYTE, stride, pointer}, "edge_flag_pointer");
}

void index_pointer(Context& context, GLenum type, GLsizei stride, const GLvoid* pointer) {
  set_pointer(context, context.vertex_array.index, true,
              one_of(type, {GL_UNSIGNED_BYTE, GL_SHORT, GL_INT, GL_FLOAT, GL_DOUBLE}),
              {false, 1, type, stride, pointer}, "index_pointer");
}

void vertex_pointer_ext(Context& context, GLint size, GLenum type, GLsizei stride, GLsizei count,
                        const GLvoid* pointer) {
  set_pointer_and_count(context, context.vertex_array.vertex, count, "vertex_pointer_ext",
                        [&] { vertex_pointer(context, size, type, stride, pointer); });
}

void color_pointer_ext(Context& context, GLint size, GLenum type, GLsizei stride, GLsizei count,
                       const GLvoid* pointer) {
  set_pointer_and_count(context, context.vertex_array.color, count, "color_pointer_ext",
                        [&] { color_pointer(context, size, type, stride, pointer); });
}

void normal_pointer_ext(Context& context, GLenum type, GLsizei stride, GLsizei count, const GLvoid* pointer) {
  set_pointer_and_count(context, context.vertex_array.normal, count, "normal_pointer_ext",
                        [&] { normal_pointer(context, type, stride, pointer); });
}

void tex_coord_pointer_ext(Context& context, GLint size, GLenum type, GLsizei stride, GLsizei count,
                           const GLvoid* pointer) {
  set_pointer_and_count(context, context.vertex_array.tex_coord, count, "tex_coord_pointer_ext",
                        [&] { tex_coord_pointer(context, size, type, stride, pointer); });
}

void edge_flag_pointer_ext(Context& context, GLsizei stride, GLsizei count, const GLboolean* pointer) {
  set_pointer_and_count(context, context.vertex_array.edge_flag, count, "edge_flag_pointer_ext",
                        [&] { edge_flag_pointer(context, stride, pointer); });
}

void index_pointer_ext(Context& context, GLenum type, GLsizei stride, GLsizei count, const GLvoid* pointer) {
  set_pointer_and_count(context, context.vertex_array.index, count, "index_pointer_ext",
                        [&] { index_pointer(context, type, stride, pointer); });
}

void interleaved_arrays(Context& context, GLenum format, GLsizei stride, const GLvoid* pointer) {
  const auto* f = std::find_if(std::begin(kInterleavedFormats), std::end(kInterleavedFormats),
                               [format](const InterleavedFormat& row) { return row.name == format; });
  if (f == std::end(kInterleavedFormats)) return record_error(context, GL_INVALID_ENUM);
  if (stride < 0) return record_error(context, GL_INVALID_VALUE);
  const GLsizei step = stride ? stride : f->stride;
  VertexArrayState& arrays = context.vertex_array;
  arrays.edge_flag.enabled = false;
  arrays.index.enabled = false;
  arrays.tex_coord.enabled = arrays.color.enabled = arrays.normal.enabled = false;
  if (f->tex_coord_size) {
    arrays.tex_coord = interleaved_array(true, f->tex_coord_size, GL_FLOAT, step, pointer, 0);
  }
  if (f->color_size) {
    arrays.color = interleaved_array(true, f->color_size, f->color_type, step, pointer, f->color_offset);
  }
  if (f->normal) arrays.normal = interleaved_array(true, 3, GL_FLOAT, step, pointer, f->normal_offset);
  arrays.vertex = interleaved_array(true, f->vertex_size, GL_FLOAT, step, pointer, f->vertex_offset);
}

void enable_client_state(Context& context, GLenum array) {
  set_client_state(context, array, true, "enable_client_state");
}

void disable_client_state(Context& context, GLenum array) {
  set_client_state(context, array, false, "disable_client_state");
}

void get_pointerv(Context& context, GLenum pname, GLvoid** params) {
  const VertexArrayState& arrays = context.vertex_array;
  const void* pointer = nullptr;
  switch (pname) {
    case GL_VERTEX_ARRAY_POINTER:
      pointer = arrays.vertex.pointer;
      break;
    case GL_COLOR_ARRAY_POINTER:
      pointer = arrays.color.pointer;
      break;
    case GL_TEXTURE_COORD_ARRAY_POINTER:
      pointer = arrays.tex_coord.pointer;
      break;
    case GL_NORMAL_ARRAY_POINTER:
      pointer = arrays.normal.pointer;
      break;
    case GL_EDGE_FLAG_ARRAY_POINTER:
      pointer = arrays.edge_flag.pointer;
      break;
    case GL_INDEX_ARRAY_POINTER:
      pointer = arrays.index.pointer;
      break;
    case GL_FEEDBACK_BUFFER_POINTER:
      pointer = context.feedback.buffer;
      break;
    case GL_SELECTION_BUFFER_POINTER:
      pointer = context.selection.buffer;
      break;
    default:
      return record_error(context, GL_INVALID_ENUM);
  }
  *params = const_cast<void*>(pointer);
}

}  // namespace op

#define ARRAY_ROW(name, kind, array, field)                                                          \
  {                                                                                                  \
    name, GetKind::kind, 1, [](const Context& c, double* out) { *out = c.vertex_array.array.field; } \
  }

std::span<const GetRow> vertex_array_get_rows() {
  static constexpr GetRow kRows[] = {
      ARRAY_ROW(GL_VERTEX_ARRAY, boolean, vertex, enabled),
      ARRAY_ROW(GL_VERTEX_ARRAY_SIZE, integer, vertex, size),
      ARRAY_ROW(GL_VERTEX_ARRAY_TYPE, enumeration, vertex, type),
      ARRAY_ROW(GL_VERTEX_ARRAY_STRIDE, integer, vertex, stride),
      ARRAY_ROW(GL_VERTEX_ARRAY_COUNT_EXT, integer, vertex, count),
      ARRAY_ROW(GL_COLOR_ARRAY, boolean, color, enabled),
      ARRAY_ROW(GL_COLOR_ARRAY_SIZE, integer, color, size),
      ARRAY_ROW(GL_COLOR_ARRAY_TYPE, enumeration, color, type),
      ARRAY_ROW(GL_COLOR_ARRAY_STRIDE, integer, color, stride),
      ARRAY_ROW(GL_COLOR_ARRAY_COUNT_EXT, integer, color, count),
      ARRAY_ROW(GL_TEXTURE_COORD_ARRAY, boolean, tex_coord, enabled),
      ARRAY_ROW(GL_TEXTURE_COORD_ARRAY_SIZE, integer, tex_coord, size),
      ARRAY_ROW(GL_TEXTURE_COORD_ARRAY_TYPE, enumeration, tex_coord, type),
      ARRAY_ROW(GL_TEXTURE_COORD_ARRAY_STRIDE, integer, tex_coord, stride),
      ARRAY_ROW(GL_TEXTURE_COORD_ARRAY_COUNT_EXT, integer, tex_coord, count),
      ARRAY_ROW(GL_NORMAL_ARRAY, boolean, normal, enabled),
      ARRAY_ROW(GL_NORMAL_ARRAY_TYPE, enumeration, normal, type),
      ARRAY_ROW(GL_NORMAL_ARRAY_STRIDE, integer, normal, stride),
      ARRAY_ROW(GL_NORMAL_ARRAY_COUNT_EXT, integer, normal, count),
      ARRAY_ROW(GL_EDGE_FLAG_ARRAY, boolean, edge_flag, enabled),
      ARRAY_ROW(GL_EDGE_FLAG_ARRAY_STRIDE, integer, edge_flag, stride),
      ARRAY_ROW(GL_EDGE_FLAG_ARRAY_COUNT_EXT, integer, edge_flag, count),
      ARRAY_ROW(GL_INDEX_ARRAY, boolean, index, enabled),
      ARRAY_ROW(GL_INDEX_ARRAY_TYPE, enumeration, index, type),
      ARRAY_ROW(GL_INDEX_ARRAY_STRIDE, integer, index, stride),
      ARRAY_ROW(GL_INDEX_ARRAY_COUNT_EXT, integer, index, count),
  };
  return kRows;
}
#undef ARRAY_ROW

}  // namespace halfspace::state
