// Vertex arrays in display lists: their elements are read when the list is compiled (spec 5.4).
#include <cstring>

#include "state/list_compile.h"
#include "state/vertex_fetch.h"

namespace halfspace::state {
namespace {

struct ArrayColumn {
  ListAttribute attribute;
  const ClientArray* array;
  Conversion conversion;
};

std::array<ArrayColumn, kListAttributes> attribute_arrays(const VertexArrayState& arrays) {
  return {{{kListColor, &arrays.color, Conversion::normalized},
           {kListNormal, &arrays.normal, Conversion::normalized},
           {kListTexCoord, &arrays.tex_coord, Conversion::plain},
           {kListEdgeFlag, &arrays.edge_flag, Conversion::plain},
           {kListIndex, &arrays.index, Conversion::plain}}};
}

// What the enabled arrays hold for one vertex. A null array and an element out of memory count as not
// enabled.
void read_attributes(Context& context, size_t index, ListValues& values) {
  VertexArrayState& arrays = context.vertex_array;
  for (const ArrayColumn& column : attribute_arrays(arrays)) {
    if (!column.array->enabled || !elements_are_readable(arrays, *column.array, index, index)) continue;
    float* out = values.value[column.attribute].data();
    constexpr float kDefaults[4] = {0, 0, 0, 1};
    std::memcpy(out, kDefaults, sizeof kDefaults);
    fetch_element(*column.array, column.conversion, index, out);
    values.known = uint8_t(values.known | 1u << column.attribute);
  }
}

bool read_position(Context& context, size_t index, float out[4]) {
  VertexArrayState& arrays = context.vertex_array;
  if (!arrays.vertex.enabled || !elements_are_readable(arrays, arrays.vertex, index, index)) return false;
  out[0] = out[1] = out[2] = 0;
  out[3] = 1;
  fetch_element(arrays.vertex, Conversion::plain, index, out);
  return true;
}

void add_element(Context& context, size_t index, ListBatchBuilder& builder) {
  ListValues values;
  float position[4];
  read_attributes(context, index, values);
  if (read_position(context, index, position)) builder.add_vertex(position, values);
}

ListBatchBuilder start_arrays(GLenum mode) {
  ListBatchBuilder builder;
  builder.mode = mode;
  builder.pairs = {0};
  return builder;
}

size_t index_at(const void* indices, GLenum type, size_t i) {
  const auto* bytes = static_cast<const std::byte*>(indices) + i * type_bytes(type);
  if (type == GL_UNSIGNED_BYTE) return std::to_integer<size_t>(*bytes);
  GLushort narrow;
  GLuint wide;
  if (type == GL_UNSIGNED_SHORT) return std::memcpy(&narrow, bytes, sizeof narrow), narrow;
  return std::memcpy(&wide, bytes, sizeof wide), wide;
}

// Adds the vertices to the list, or where the command is going to be refused, the command.
template <auto kOperation, class... Arguments>
void compile_arrays(Context& context, bool valid, GLenum mode, size_t count, auto&& index,
                    Arguments... arguments) {
  compiling(context, [&] {
    if (!valid) return Compiled<kOperation>::record(context, arguments...);
    ListBatchBuilder builder = start_arrays(mode);
    for (size_t i = 0; i < count; ++i) add_element(context, index(i), builder);
    context.lists.compiler.add_arrays(builder);
  });
}

}  // namespace

namespace compile {

// The attributes and the vertex, as if they had been given one by one.
void array_element(Context& context, GLint i) {
  if (i < 0) return Compiled<&OperationTable::array_element>::compile(context, i);
  ListValues values;
  float v[4];
  read_attributes(context, size_t(i), values);
  const auto& value = values.value;
  if (values.knows(kListIndex)) compile::index(context, value[kListIndex][0]);
  if (values.knows(kListEdgeFlag)) edge_flag(context, value[kListEdgeFlag][0] != 0);
  if (values.knows(kListTexCoord)) {
    const auto& t = value[kListTexCoord];
    tex_coord(context, t[0], t[1], t[2], t[3]);
  }
  if (values.knows(kListColor)) {
    const auto& c = value[kListColor];
    color(context, c[0], c[1], c[2], c[3]);
  }
  if (values.knows(kListNormal)) {
    const auto& n = value[kListNormal];
    normal(context, n[0], n[1], n[2]);
  }
  if (read_position(context, size_t(i), v)) vertex(context, v[0], v[1], v[2], v[3]);
}

void draw_arrays(Context& context, GLenum mode, GLint first, GLsizei count) {
  const bool valid = mode <= GL_POLYGON && first >= 0 && count >= 0;
  const auto index = [&](size_t i) { return size_t(first) + i; };
  compile_arrays<&OperationTable::draw_arrays>(context, valid, mode, size_t(count), index, mode, first,
                                               count);
  Compiled<&OperationTable::draw_arrays>::execute(context, mode, first, count);
}

void draw_elements(Context& context, GLenum mode, GLsizei count, GLenum type, const GLvoid* indices) {
  using Operation = Compiled<&OperationTable::draw_elements>;
  const bool known_type = type == GL_UNSIGNED_BYTE || type == GL_UNSIGNED_SHORT || type == GL_UNSIGNED_INT;
  const bool valid = mode <= GL_POLYGON && known_type && count >= 0;
  const auto index = [&](size_t i) { return index_at(indices, type, i); };
  const size_t length = indices != nullptr ? size_t(count) : 0;
  // What is recorded is refused before its indices are looked at.
  compile_arrays<&OperationTable::draw_elements>(context, valid, mode, length, index, mode, count, type,
                                                 static_cast<const GLvoid*>(nullptr));
  Operation::execute(context, mode, count, type, indices);
}

}  // namespace compile
}  // namespace halfspace::state
