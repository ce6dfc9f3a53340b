// Transform, rasterisation and attribute stacks.
#include "maker.h"

namespace halfspace::fuzz {
namespace {

void add_matrix(Maker& m) {
  switch (m.random.below(6)) {
    case 0:
      m.call(Command::glTranslatef,
             {m.random.real(-0.5, 0.5), m.random.real(-0.5, 0.5), m.random.real(-0.3, 0.3)});
      break;
    case 1:
      m.call(Command::glRotated, {m.random.real(-180, 180), m.random.real(-1, 1), m.random.real(-1, 1), 1});
      break;
    case 2:
      m.call(Command::glScalef, {m.random.real(0.5, 1.5), m.random.real(0.5, 1.5), m.random.real(0.5, 1.5)});
      break;
    case 3:
      if (m.pushed_matrices < 20) m.call(Command::glPushMatrix), ++m.pushed_matrices;
      break;
    case 4:
      if (m.pushed_matrices > 0) m.call(Command::glPopMatrix), --m.pushed_matrices;
      break;
    default: {
      std::vector<float> matrix(16);
      for (size_t i = 0; i < 16; ++i)
        matrix[i] = static_cast<float>(i % 5 == 0 ? m.random.real(0.75, 1.25) : m.random.real(-0.125, 0.125));
      matrix[3] = matrix[7] = matrix[11] = 0;
      matrix[15] = 1;
      m.call(Command::glMultMatrixf, {0}, matrix);
    }
  }
}

void add_viewport(Maker& m) {
  const int x = m.random.between(-20, 40), y = m.random.between(-20, 30);
  m.call(Command::glViewport,
         {double(x), double(y), double(m.random.between(20, 120)), double(m.random.between(20, 90))});
}

void add_depth_range(Maker& m) { m.call(Command::glDepthRange, {m.random.real(0, 1), m.random.real(0, 1)}); }

// Mesa cuts polygons into triangles first, so that a plane of the program's makes points on their diagonals.
void leave_out_diagonals(Maker& m) {
  if (m.polygon_points && m.clip_planes) m.triangles_only = true;
}

void add_clip_plane(Maker& m) {
  if (m.polygon_points && !m.lists.empty()) return;
  m.clip_planes = true;
  leave_out_diagonals(m);
  const double plane = GL_CLIP_PLANE0 + m.random.below(6);
  m.call(Command::glClipPlane, {plane, 0},
         std::vector<double>{m.random.real(-1, 1), m.random.real(-1, 1), m.random.real(-1, 1),
                             m.random.real(0, 1)});
  m.set_enabled(static_cast<GLenum>(plane), m.random.chance(75));
}

void draw_flat(Maker& m) {
  m.flat = true;
  m.call(Command::glShadeModel, {GL_FLAT});
}

void add_shade_model(Maker& m) {
  m.call(Command::glShadeModel, {double(m.exact || m.flat || m.random.chance(50) ? GL_FLAT : GL_SMOOTH)});
}

void add_culling(Maker& m) {
  m.set_enabled(GL_CULL_FACE, m.random.chance(70));
  m.call(Command::glCullFace, {double(m.random.pick({GL_FRONT, GL_BACK, GL_FRONT_AND_BACK}))});
  m.call(Command::glFrontFace, {double(m.random.pick({GL_CW, GL_CCW}))});
}

// Not with stippled lines: where two polygons meet their edge is drawn twice, each time out of step in
// another way.
void add_polygon_mode(Maker& m) {
  if (m.stippled || !m.lists.empty()) return;
  prepare_for_edges(m);
  m.call(Command::glPolygonMode, {double(m.random.pick({GL_FRONT, GL_BACK, GL_FRONT_AND_BACK})),
                                  double(m.random.pick({GL_POINT, GL_LINE, GL_FILL}))});
}

void add_polygon_stipple(Maker& m) {
  std::vector<uint8_t> pattern(128);
  for (uint8_t& byte : pattern) byte = static_cast<uint8_t>(m.random.bits());
  m.call(Command::glPixelStorei, {GL_UNPACK_ALIGNMENT, 1});
  m.call(Command::glPolygonStipple, {0}, pattern);
  m.set_enabled(GL_POLYGON_STIPPLE, m.random.chance(75));
}

// The unit of the offset is the implementation's: enough to part what lies in one plane, too little to be
// seen elsewhere.
void add_polygon_offset(Maker& m) {
  m.call(Command::glPolygonOffset, {0, m.random.pick({0.0, 4096.0, -4096.0})});
  m.set_enabled(static_cast<GLenum>(
                    m.random.pick({GL_POLYGON_OFFSET_FILL, GL_POLYGON_OFFSET_LINE, GL_POLYGON_OFFSET_POINT})),
                m.random.chance(75));
  m.set_enabled(GL_DEPTH_TEST, true);
}

void add_line(Maker& m) {
  if (m.random.chance(50)) m.call(Command::glLineWidth, {double(m.random.between(1, 5))});
}

// Mesa counts lengths, not pixels, so that its pattern is soon out of step: patterns with no run longer than
// two.
// And attributes are not in perspective there.
void add_line_stipple(Maker& m) {
  if (m.polygon_points) return;
  m.stippled = true;
  draw_flat(m);
  m.call(Command::glLineStipple, {1, double(m.random.pick({0xAAAA, 0x3333, 0x6DB6, 0x9249, 0x5555}))});
  m.set_enabled(GL_LINE_STIPPLE, m.random.chance(75));
}

// Of a smooth point of one pixel Mesa draws a pixel, the covered parts of four are right.
void add_point_size(Maker& m) {
  m.call(Command::glPointSize, {double(m.random.between(m.smooth ? 2 : 1, 9))});
}

// How much of a pixel is covered, is for each renderer to say: widened() in verdict.h.
// Mesa's points of polygons have no smooth edges.
void add_smoothing(Maker& m) {
  if (m.polygon_points) return;
  m.smooth = true;
  m.set_enabled(static_cast<GLenum>(m.random.pick({GL_POINT_SMOOTH, GL_LINE_SMOOTH})), m.random.chance(75));
  add_point_size(m);
  m.set_enabled(GL_BLEND, true);
  m.call(Command::glBlendFunc, {GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA});
}

void add_push_attributes(Maker& m) {
  if (m.pushed_attributes >= 12) return;
  uint32_t mask = m.random.chance(40) ? GL_ALL_ATTRIB_BITS : m.random.bits() & 0xfffff;
  // Of current values saved twice, Mesa brings back the wrong ones.
  if (m.pushed_attributes > 0) mask &= ~uint32_t{GL_CURRENT_BIT};
  m.call(Command::glPushAttrib, {double(mask)});
  ++m.pushed_attributes;
}

void add_pop_attributes(Maker& m) {
  if (m.pushed_attributes == 0) return;
  m.call(Command::glPopAttrib);
  --m.pushed_attributes;
  if (m.flat) draw_flat(m);
}

}  // namespace

// In which order the edges of a polygon are drawn is open: let them have one colour.
void prepare_for_edges(Maker& m) {
  m.polygon_points = true;
  if (m.smooth) {
    m.set_enabled(GL_POINT_SMOOTH, false);
    m.set_enabled(GL_LINE_SMOOTH, false);
  }
  leave_out_diagonals(m);
  draw_flat(m);
  m.set_enabled(GL_TEXTURE_1D, false);
  m.set_enabled(GL_TEXTURE_2D, false);
}

const std::vector<Feature>& state_features() {
  static const std::vector<Feature> kFeatures = {
      {"matrix", add_matrix, 3},
      {"viewport", add_viewport},
      {"depth", add_depth_range},
      {"clip_plane", add_clip_plane, 2},
      {"shade_model", add_shade_model},
      {"cull", add_culling},
      {"polygon_mode", add_polygon_mode, 2},
      {"polygon_stipple", add_polygon_stipple},
      {"polygon_offset", add_polygon_offset},
      {"line", add_line},
      {"line_stipple", add_line_stipple},
      {"point", add_point_size},
      {.group = "smooth", .add = add_smoothing, .exact = false},
      {"attributes", add_push_attributes, 2},
      {"attributes", add_pop_attributes, 2},
  };
  return kFeatures;
}

}  // namespace halfspace::fuzz
