// Primitives: what they look like, and the ways GL has of taking them.
#include <cmath>

#include "maker.h"

namespace halfspace::fuzz {
namespace {

using Vector = std::vector<double>;

// A point of a plane: `u` and `v` are its coordinates there. Attributes are linear in them, so that it does
// not matter how a polygon is cut into triangles.
struct Plane {
  double center[3], u[3], v[3];
  double color[4], color_u[4], color_v[4];
  double tex[2], tex_u[2], tex_v[2];
  double normal[3];

  Vertex at(double x, double y) const {
    Vertex vertex;
    for (int i = 0; i < 3; ++i) vertex.position[i] = center[i] + x * u[i] + y * v[i];
    for (int i = 0; i < 4; ++i) vertex.color[i] = color[i] + x * color_u[i] + y * color_v[i];
    for (int i = 0; i < 2; ++i) vertex.tex_coord[i] = tex[i] + x * tex_u[i] + y * tex_v[i];
    for (int i = 0; i < 3; ++i) vertex.normal[i] = normal[i];
    return vertex;
  }
};

Plane random_plane(Maker& m) {
  Random& r = m.random;
  Plane plane{};
  const double turn = r.real(0, 6.25), size = r.real(0.25, 0.75);
  for (int i = 0; i < 3; ++i) plane.center[i] = r.real(-0.5, 0.5);
  const double u[3] = {size * std::cos(turn), size * std::sin(turn), r.real(-0.4, 0.4)};
  const double v[3] = {-size * std::sin(turn), size * std::cos(turn), r.real(-0.4, 0.4)};
  for (int i = 0; i < 3; ++i) plane.u[i] = u[i], plane.v[i] = v[i];
  for (int i = 0; i < 4; ++i) {
    plane.color[i] = m.exact ? r.level() : r.real(0.3, 0.7);
    plane.color_u[i] = m.exact ? 0 : r.real(-0.15, 0.15);
    plane.color_v[i] = m.exact ? 0 : r.real(-0.15, 0.15);
  }
  for (int i = 0; i < 2; ++i) {
    plane.tex[i] = r.real(-0.5, 1);
    plane.tex_u[i] = r.real(-1, 1);
    plane.tex_v[i] = r.real(-1, 1);
  }
  for (double& n : plane.normal) n = r.real(-1, 1);
  plane.normal[2] = 1;
  return plane;
}

void paint_at_random(Maker& m, Vertex& vertex) {
  const std::vector<float> color = m.color();
  for (size_t i = 0; i < 4; ++i) vertex.color[i] = double(color[i]);
  for (double& n : vertex.normal) n = m.random.real(-1, 1);
}

Vertex random_vertex(Maker& m) {
  Vertex vertex;
  for (int i = 0; i < 3; ++i) vertex.position[i] = m.random.real(-1, 1);
  for (int i = 0; i < 2; ++i) vertex.tex_coord[i] = m.random.real(-1, 2);
  paint_at_random(m, vertex);
  return vertex;
}

// The corners of something flat and convex, counted by the mode.
std::vector<Vertex> flat_vertices(Maker& m, GLenum mode) {
  std::vector<Vertex> vertices;
  const Plane plane = random_plane(m);
  if (mode == GL_POLYGON) {
    const int count = m.random.between(3, 8);
    for (int i = 0; i < count; ++i)
      vertices.push_back(plane.at(std::cos(6.2831853 * i / count), std::sin(6.2831853 * i / count)));
  } else if (mode == GL_QUAD_STRIP) {
    const int count = m.random.between(2, 5);
    for (int i = 0; i < count; ++i) {
      vertices.push_back(plane.at(-1 + 2.0 * i / count, -0.7));
      vertices.push_back(plane.at(-1 + 2.0 * i / count, 0.7));
    }
  } else {
    const int count = m.random.between(1, 3);
    for (int i = 0; i < count; ++i) {
      const Plane another = random_plane(m);
      for (auto [x, y] : {std::pair{-1., -1.}, {1., -1.}, {1., 1.}, {-1., 1.}})
        vertices.push_back(another.at(x, y));
    }
  }
  return vertices;
}

void emit_attributes(Maker& m, const Vertex& v, bool colors, bool tex_coords, bool normals) {
  if (colors) {
    if (m.in_list || m.random.chance(70)) {
      m.call(Command::glColor4d, {v.color[0], v.color[1], v.color[2], v.color[3]});
    } else {
      const auto byte = [](double c) { return double(std::lround(c * 255)); };
      m.call(Command::glColor4ub, {byte(v.color[0]), byte(v.color[1]), byte(v.color[2]), byte(v.color[3])});
    }
  }
  if (tex_coords) m.call(Command::glTexCoord2d, {v.tex_coord[0], v.tex_coord[1]});
  if (normals) m.call(Command::glNormal3d, {v.normal[0], v.normal[1], v.normal[2]});
}

void draw_immediately(Maker& m, const Shape& shape) {
  // Mesa's lists record an error when the set of attributes changes: there, have all of them.
  const bool all = m.in_list;
  const bool colors = all || m.random.chance(85), tex_coords = all || m.random.chance(70),
             normals = all || m.random.chance(70);
  m.call(Command::glBegin, {double(shape.mode)});
  for (const Vertex& v : shape.vertices) {
    emit_attributes(m, v, colors, tex_coords, normals);
    m.call(Command::glVertex3d, {v.position[0], v.position[1], v.position[2]});
  }
  m.call(Command::glEnd);
}

template <typename Get>
std::vector<float> gather(const Shape& shape, int size, Get get) {
  std::vector<float> numbers;
  for (const Vertex& v : shape.vertices) {
    for (int i = 0; i < size; ++i) numbers.push_back(static_cast<float>(get(v)[i]));
  }
  // A stream that is cut down may draw more from an array than was meant for it.
  numbers.resize(16 * static_cast<size_t>(size));
  return numbers;
}

void set_array(Maker& m, GLenum array, bool on) {
  m.call(on ? Command::glEnableClientState : Command::glDisableClientState, {double(array)});
}

void draw_arrays(Maker& m, const Shape& shape) {
  const bool colors = m.random.chance(80), tex_coords = m.random.chance(60), normals = m.random.chance(60);
  m.call(Command::glVertexPointer, {3, GL_FLOAT, 0, 0},
         gather(shape, 3, [](const Vertex& v) { return v.position; }));
  m.call(Command::glColorPointer, {4, GL_FLOAT, 0, 0},
         gather(shape, 4, [](const Vertex& v) { return v.color; }));
  m.call(Command::glTexCoordPointer, {2, GL_FLOAT, 0, 0},
         gather(shape, 2, [](const Vertex& v) { return v.tex_coord; }));
  m.call(Command::glNormalPointer, {GL_FLOAT, 0, 0},
         gather(shape, 3, [](const Vertex& v) { return v.normal; }));
  set_array(m, GL_VERTEX_ARRAY, true);
  set_array(m, GL_COLOR_ARRAY, colors);
  set_array(m, GL_TEXTURE_COORD_ARRAY, tex_coords);
  set_array(m, GL_NORMAL_ARRAY, normals);
  const int count = static_cast<int>(shape.vertices.size());
  switch (m.random.below(3)) {
    case 0:
      m.call(Command::glDrawArrays, {double(shape.mode), 0, double(count)});
      break;
    case 1: {
      std::vector<GLushort> indices;
      for (int i = 0; i < count; ++i) indices.push_back(static_cast<GLushort>(i));
      m.call(Command::glDrawElements, {double(shape.mode), double(count), GL_UNSIGNED_SHORT, 0}, indices);
      break;
    }
    default:
      m.call(Command::glBegin, {double(shape.mode)});
      for (int i = 0; i < count; ++i) m.call(Command::glArrayElement, {double(i)});
      m.call(Command::glEnd);
  }
  reset_current(m);
}

void add_shape(Maker& m) {
  const Shape shape = random_shape(m);
  draw_immediately(m, shape);
}

void add_arrays(Maker& m) { draw_arrays(m, random_shape(m)); }

// Elsewhere flags are ignored, and not by Mesa.
void add_edge_flags(Maker& m) {
  if (m.stippled || !m.lists.empty()) return;
  prepare_for_edges(m);
  Shape shape = random_shape(m);
  while (shape.mode != GL_TRIANGLES && shape.mode != GL_QUADS && shape.mode != GL_POLYGON)
    shape = random_shape(m);
  for (Vertex& v : shape.vertices) v.edge = m.random.chance(50);
  m.call(Command::glPolygonMode, {GL_FRONT_AND_BACK, double(m.random.pick({GL_LINE, GL_POINT}))});
  m.call(Command::glBegin, {double(shape.mode)});
  for (const Vertex& v : shape.vertices) {
    m.call(Command::glEdgeFlag, {double(v.edge)});
    m.call(Command::glVertex3d, {v.position[0], v.position[1], v.position[2]});
  }
  m.call(Command::glEdgeFlag, {1});
  m.call(Command::glEnd);
}

void add_rect(Maker& m) {
  if (m.triangles_only && m.polygon_points) return;
  const std::vector<float> color = m.color();
  m.call(Command::glColor4f, {double(color[0]), double(color[1]), double(color[2]), double(color[3])});
  // Two in one plane would fight for depth.
  m.call(Command::glTranslatef, {0, 0, m.random.real(-0.125, 0.125)});
  m.call(Command::glRectf,
         {m.random.real(-1, 1), m.random.real(-1, 1), m.random.real(-1, 1), m.random.real(-1, 1)});
}

}  // namespace

Shape random_shape(Maker& m) {
  Shape shape;
  shape.mode = m.triangles_only ? m.random.pick<GLenum>({GL_POINTS, GL_LINES, GL_LINE_STRIP, GL_TRIANGLES,
                                                         GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN})
                                : static_cast<GLenum>(m.random.below(10));
  // Having compiled a loop, Mesa takes its first colour for the current one.
  if (m.in_list && shape.mode == GL_LINE_LOOP) shape.mode = GL_LINE_STRIP;
  // Mesa joins the strips of a list by triangles without area, whose edges show.
  if (m.in_list && m.polygon_points && (shape.mode == GL_TRIANGLE_STRIP || shape.mode == GL_QUAD_STRIP))
    shape.mode = GL_TRIANGLE_FAN;
  if (shape.mode >= GL_QUADS) {
    shape.vertices = flat_vertices(m, shape.mode);
  } else {
    int count = m.random.between(shape.mode >= GL_TRIANGLES ? 3 : 2, 9);
    if (m.in_list) count -= shape.mode == GL_LINES ? count % 2 : shape.mode == GL_TRIANGLES ? count % 3 : 0;
    for (int i = 0; i < count; ++i) shape.vertices.push_back(random_vertex(m));
  }
  return shape;
}

void draw_shape(Maker& m, const Shape& shape) { draw_immediately(m, shape); }
void draw_with_arrays(Maker& m, const Shape& shape) { draw_arrays(m, shape); }

void reset_current(Maker& m) {
  const std::vector<float> color = m.color();
  m.call(Command::glColor4f, {double(color[0]), double(color[1]), double(color[2]), double(color[3])});
  m.call(Command::glTexCoord2f, {0, 0});
  m.call(Command::glNormal3f, {0, 0, 1});
}

const std::vector<Feature>& drawing_features() {
  static const std::vector<Feature> kFeatures = {
      {.group = "shape", .add = add_shape, .weight = 6, .draws = true},
      {.group = "array", .add = add_arrays, .weight = 3, .draws = true},
      {.group = "edge_flag", .add = add_edge_flags, .draws = true},
      {.group = "rect", .add = add_rect, .draws = true},
  };
  return kFeatures;
}

}  // namespace halfspace::fuzz
