#include "state/current.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace op {

void color(Context& context, GLfloat r, GLfloat g, GLfloat b, GLfloat a) {
  float* c = context.current.color;
  ImmediateState& immediate = context.immediate;
  // Only a change after the batch's first vertex makes the colour vary; outside Begin/End cursor and start
  // differ from nothing that is drawn. Other bits are another colour: two words are compared sooner than four floats.
  using Words = std::array<uint64_t, 2>;
  const auto next = std::bit_cast<Words>(std::array{r, g, b, a});
  Words last;
  std::memcpy(&last, c, sizeof last);
  const bool differs = ((next[0] ^ last[0]) | (next[1] ^ last[1])) != 0;
  immediate.color_varies |= differs & (immediate.cursor != immediate.buffer.data());
  std::memcpy(c, &next, sizeof next);
}

void normal(Context& context, GLfloat x, GLfloat y, GLfloat z) {
  float* n = context.current.normal;
  n[0] = x;
  n[1] = y;
  n[2] = z;
}

void tex_coord(Context& context, GLfloat s, GLfloat t, GLfloat r, GLfloat q) {
  float* c = context.current.tex_coord;
  c[0] = s;
  c[1] = t;
  c[2] = r;
  c[3] = q;
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
      {GL_CURRENT_INDEX, GetKind::real, 1, [](const Context& c, double* out) { *out = double(c.current.index); }},
      {GL_EDGE_FLAG, GetKind::boolean, 1, [](const Context& c, double* out) { *out = c.current.edge_flag; }},
  };
  return kRows;
}

}  // namespace halfspace::state
