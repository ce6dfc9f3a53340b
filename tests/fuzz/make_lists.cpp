// Display lists and evaluators.
#include "maker.h"

namespace halfspace::fuzz {
namespace {

void add_list(Maker& m) {
  if (m.in_list) return;
  m.in_list = true;
  const double name = 1 + m.random.below(4);
  const bool compile = m.random.chance(70);
  m.call(Command::glNewList, {name, double(compile ? GL_COMPILE : GL_COMPILE_AND_EXECUTE)});
  const int count = m.random.between(1, 3);
  for (int i = 0; i < count; ++i) {
    if (m.random.chance(30))
      m.call(Command::glTranslatef, {m.random.real(-0.2, 0.2), m.random.real(-0.2, 0.2), 0});
    draw_shape(m, random_shape(m));
  }
  m.call(Command::glEndList);
  m.in_list = false;
  m.lists.push_back(name);
  if (compile) m.call(Command::glCallList, {name});
}

void add_call_lists(Maker& m) {
  if (m.lists.empty()) return add_list(m);
  std::vector<GLubyte> names(static_cast<size_t>(m.random.between(1, 4)));
  for (GLubyte& name : names) name = static_cast<GLubyte>(m.random.below(4));
  m.call(Command::glListBase, {1});
  m.call(Command::glCallLists, {double(names.size()), GL_UNSIGNED_BYTE, 0}, names);
}

// Control points of a gently bent patch.
std::vector<float> patch(Maker& m, int u_order, int v_order, int size, bool position) {
  std::vector<float> points;
  for (int v = 0; v < v_order; ++v) {
    for (int u = 0; u < u_order; ++u) {
      for (int i = 0; i < size; ++i) {
        double value = m.random.real(0.2, 0.8);
        if (position) {
          const double along = i == 0        ? u / double(u_order - 1)
                               : v_order > 1 ? v / double(v_order - 1)
                                             : m.random.real(0, 1);
          value = i == 2 ? m.random.real(-0.4, 0.4) : i == 3 ? 1 : 1.6 * along - 0.8;
        }
        points.push_back(static_cast<float>(value));
      }
    }
  }
  return points;
}

// With Mesa, current values are what was evaluated last.
void restore_current(Maker& m) {
  const std::vector<float> color = m.color();
  m.call(Command::glColor4f, {double(color[0]), double(color[1]), double(color[2]), double(color[3])});
  m.call(Command::glNormal3f, {0, 0, 1});
}

// Finely divided: between the corners of a grid a curve is straight in every renderer, but colours are not
// linear.
void add_map_1(Maker& m) {
  const int order = m.random.between(2, 5);
  m.call(Command::glMap1f, {GL_MAP1_VERTEX_3, 0, 1, 3, double(order), 0}, patch(m, order, 1, 3, true));
  m.set_enabled(GL_MAP1_VERTEX_3, true);
  const bool colors = !m.exact && m.random.chance(50);
  if (colors) m.call(Command::glMap1f, {GL_MAP1_COLOR_4, 0, 1, 4, 3, 0}, patch(m, 3, 1, 4, false));
  m.set_enabled(GL_MAP1_COLOR_4, colors);
  if (m.random.chance(50)) {
    const int steps = m.random.between(2, 20);
    m.call(Command::glMapGrid1f, {double(steps), 0, 1});
    m.call(Command::glEvalMesh1,
           {double(m.stippled ? GL_POINT : m.random.pick({GL_POINT, GL_LINE})), 0, double(steps)});
  } else {
    m.call(Command::glBegin, {GL_LINE_STRIP});
    for (int i = 0; i <= 10; ++i) m.call(Command::glEvalCoord1f, {i / 10.0});
    m.call(Command::glEnd);
  }
  restore_current(m);
}

void add_map_2(Maker& m) {
  const int u_order = m.random.between(2, 4), v_order = m.random.between(2, 4);
  m.call(Command::glMap2f,
         {GL_MAP2_VERTEX_3, 0, 1, 3, double(u_order), 0, 1, double(3 * u_order), double(v_order), 0},
         patch(m, u_order, v_order, 3, true));
  m.set_enabled(GL_MAP2_VERTEX_3, true);
  // The colour is linear, however a quadrilateral is cut.
  // Which corner colours a flat quadrilateral is another matter: Mesa has triangles.
  const bool colors = !m.exact && !m.flat && m.random.chance(50);
  if (colors) m.call(Command::glShadeModel, {GL_SMOOTH});
  if (colors)
    m.call(Command::glMap2f, {GL_MAP2_COLOR_4, 0, 1, 4, 2, 0, 1, 8, 1, 0}, patch(m, 2, 1, 4, false));
  m.set_enabled(GL_MAP2_COLOR_4, colors);
  if (m.random.chance(50)) m.set_enabled(GL_AUTO_NORMAL, m.random.chance(70));
  const int u_steps = m.random.between(4, 12), v_steps = m.random.between(4, 12);
  m.call(Command::glMapGrid2f, {double(u_steps), 0, 1, double(v_steps), 0, 1});
  // Stippled lines cross here, each out of step in another way; and Mesa fills with triangles, whose
  // diagonals show when polygons are drawn as lines.
  const double mode = m.stippled                             ? GL_POINT
                      : m.triangles_only || m.polygon_points ? GL_LINE
                                                             : m.random.pick({GL_POINT, GL_LINE, GL_FILL});
  m.call(Command::glEvalMesh2, {mode, 0, double(u_steps), 0, double(v_steps)});
  restore_current(m);
}

}  // namespace

const std::vector<Feature>& list_features() {
  static const std::vector<Feature> kFeatures = {
      {.group = "list", .add = add_list, .weight = 2, .draws = true},
      {.group = "list", .add = add_call_lists, .draws = true},
      {.group = "evaluator", .add = add_map_1, .draws = true},
      {.group = "evaluator", .add = add_map_2, .draws = true},
  };
  return kFeatures;
}

}  // namespace halfspace::fuzz
