// Compiling what goes between Begin and End.
#include "state/list_compile.h"

namespace halfspace::state {
namespace {

// `gather` takes the command into the batch or returns false; then it is a step of its own.
template <auto kOperation, class Gather, class... Arguments>
void gather_or_record(Context& context, Gather&& gather, Arguments... arguments) {
  compiling(context, [&] {
    if (!gather(context.lists.compiler)) Compiled<kOperation>::record(context, arguments...);
  });
  Compiled<kOperation>::execute(context, arguments...);
}

template <auto kOperation, class... Arguments>
void gather_attribute(Context& context, ListAttribute attribute, const float* value, Arguments... arguments) {
  const auto gather = [&](ListCompiler& compiler) { return compiler.set_attribute(attribute, value); };
  gather_or_record<kOperation>(context, gather, arguments...);
}

}  // namespace

namespace compile {

void begin(Context& context, GLenum mode) {
  gather_or_record<&OperationTable::begin>(
      context, [&](ListCompiler& compiler) { return compiler.begin(mode); }, mode);
}

void end(Context& context) {
  gather_or_record<&OperationTable::end>(context, [](ListCompiler& compiler) { return compiler.end(); });
}

void vertex(Context& context, GLfloat x, GLfloat y, GLfloat z, GLfloat w) {
  const float v[4] = {x, y, z, w};
  gather_or_record<&OperationTable::vertex>(
      context, [&](ListCompiler& compiler) { return compiler.vertex(v); }, x, y, z, w);
}

void color(Context& context, GLfloat r, GLfloat g, GLfloat b, GLfloat a) {
  const float v[4] = {r, g, b, a};
  gather_attribute<&OperationTable::color>(context, kListColor, v, r, g, b, a);
}

void normal(Context& context, GLfloat x, GLfloat y, GLfloat z) {
  const float v[3] = {x, y, z};
  gather_attribute<&OperationTable::normal>(context, kListNormal, v, x, y, z);
}

void tex_coord(Context& context, GLfloat s, GLfloat t, GLfloat r, GLfloat q) {
  const float v[4] = {s, t, r, q};
  gather_attribute<&OperationTable::tex_coord>(context, kListTexCoord, v, s, t, r, q);
}

void edge_flag(Context& context, GLboolean flag) {
  const float v[1] = {flag ? 1.0f : 0.0f};
  gather_attribute<&OperationTable::edge_flag>(context, kListEdgeFlag, v, flag);
}

void index(Context& context, GLfloat c) {
  const float v[1] = {c};
  gather_attribute<&OperationTable::index>(context, kListIndex, v, c);
}

void material(Context& context, GLenum face, GLenum pname, const GLfloat* params) {
  using Operation = Compiled<&OperationTable::material>;
  const size_t count = pname_values(pname);
  compiling(context, [&] {
    if (context.lists.compiler.material(face, pname, params, count)) return;
    Operation::record(context, face, pname, keep(context, params, count));
  });
  Operation::execute(context, face, pname, params);
}

}  // namespace compile
}  // namespace halfspace::state
