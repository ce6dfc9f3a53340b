#include "state/current.h"

#include <algorithm>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"
#include "state/quad.h"

namespace halfspace::state {
namespace op {

void color(Context& context, GLfloat r, GLfloat g, GLfloat b, GLfloat a) {
  // Only after a batch's first vertex does a colour make it vary; whether it is another one, the renderer
  // looks once a batch. Outside Begin/End cursor and start differ from nothing that is drawn.
  ImmediateState& immediate = context.immediate;
  immediate.color_varies |= immediate.cursor != immediate.buffer.data();
  store_quad(Quad{r, g, b, a}, context.current.color);
}

void normal(Context& context, GLfloat x, GLfloat y, GLfloat z) {
  store_quad(Quad{x, y, z, 0}, context.current.normal);
}

void tex_coord(Context& context, GLfloat s, GLfloat t, GLfloat r, GLfloat q) {
  store_quad(Quad{s, t, r, q}, context.current.tex_coord);
}

void edge_flag(Context& context, GLboolean flag) { context.current.edge_flag = flag != GL_FALSE; }

void index(Context& context, GLfloat c) { context.current.index = c; }

}  // namespace op

std::span<const GetRow> current_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_CURRENT_COLOR, GetKind::normalized, 4,
       [](const Context& c, double* out) { std::copy_n(c.current.color, 4, out); }},
      {GL_CURRENT_TEXTURE_COORDS, GetKind::real, 4,
       [](const Context& c, double* out) { std::copy_n(c.current.tex_coord, 4, out); }},
      {GL_CURRENT_NORMAL, GetKind::normalized, 3,
       [](const Context& c, double* out) { std::copy_n(c.current.normal, 3, out); }},
      {GL_CURRENT_INDEX, GetKind::real, 1,
       [](const Context& c, double* out) { *out = double(c.current.index); }},
      {GL_EDGE_FLAG, GetKind::boolean, 1, [](const Context& c, double* out) { *out = c.current.edge_flag; }},
  };
  return kRows;
}

}  // namespace halfspace::state
