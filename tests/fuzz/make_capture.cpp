// Selection and feedback: what would be drawn is reported instead.
#include "maker.h"

namespace halfspace::fuzz {
namespace {

// Lines, points and polygons, bitmaps and images, as they come.
void add_captured(Maker& m) {
  if (m.random.chance(80)) return draw_shape(m, random_shape(m));
  m.call(Command::glRasterPos3f,
         {m.random.real(-0.9, 0.9), m.random.real(-0.9, 0.9), m.random.real(-0.5, 0.5)});
  m.call(Command::glBitmap, {8, 1, 0, 0, m.random.real(-4, 4), m.random.real(-4, 4), 0}, {0xA5});
}

void change_names(Maker& m) {
  switch (m.random.below(8)) {
    case 0:
      return m.call(Command::glInitNames);
    case 1:
    case 2:
      return m.call(Command::glPopName);
    case 3:
    case 4:
      return m.call(Command::glLoadName, {double(m.random.below(5))});
    default:
      return m.call(Command::glPushName, {double(m.random.below(1000))});
  }
}

// A hit that is a touch, or a polygon whose outline would be asked for, is open.
void add_selection(Maker& m) {
  if (m.in_list || m.polygon_points) return;
  // With room for nothing Mesa does not go there at all.
  const size_t words = m.random.chance(80) ? 1024 : static_cast<size_t>(m.random.between(1, 12));
  m.call(Command::glSelectBuffer, {double(words), 0}, std::vector<GLuint>(words));
  m.call(Command::glRenderMode, {GL_SELECT});
  if (m.random.chance(80)) m.call(Command::glInitNames);
  const int rounds = m.random.between(1, 6);
  for (int i = 0; i < rounds; ++i) {
    const int changes = m.random.between(0, 3);
    for (int k = 0; k < changes; ++k) change_names(m);
    add_captured(m);
  }
  m.call(Command::glRenderMode, {double(m.random.chance(90) ? GL_RENDER : GL_SELECT)});
  m.call(Command::glRenderMode, {GL_RENDER});
}

// Mesa generates coordinates, and takes them through their matrix, only where a texture is on.
void leave_coordinates_alone(Maker& m) {
  for (GLenum coordinate = GL_TEXTURE_GEN_S; coordinate <= GL_TEXTURE_GEN_Q; ++coordinate)
    m.set_enabled(coordinate, false);
  m.call(Command::glMatrixMode, {GL_TEXTURE});
  m.call(Command::glLoadIdentity);
  m.call(Command::glMatrixMode, {GL_MODELVIEW});
}

void add_feedback(Maker& m) {
  if (m.in_list || m.polygon_points) return;
  // In flat shading Mesa reports no colours but of the vertices they come from.
  const bool colors = !m.exact && !m.flat && m.random.chance(70);
  const double type = colors ? m.random.pick({GL_3D_COLOR, GL_3D_COLOR_TEXTURE, GL_4D_COLOR_TEXTURE})
                             : m.random.pick({GL_2D, GL_3D});
  if (colors) {
    m.call(Command::glShadeModel, {GL_SMOOTH});
    leave_coordinates_alone(m);
  }
  const size_t words = 4096;
  m.call(Command::glFeedbackBuffer, {double(words), type, 0}, std::vector<GLfloat>(words));
  m.call(Command::glRenderMode, {GL_FEEDBACK});
  const int rounds = m.random.between(1, 5);
  for (int i = 0; i < rounds; ++i) {
    m.call(Command::glPassThrough, {m.random.real(-4, 4)});
    add_captured(m);
  }
  m.call(Command::glRenderMode, {GL_RENDER});
}

}  // namespace

const std::vector<Feature>& capture_features() {
  static const std::vector<Feature> kFeatures = {
      {.group = "selection", .add = add_selection, .draws = true},
      {.group = "feedback", .add = add_feedback, .draws = true},
  };
  return kFeatures;
}

}  // namespace halfspace::fuzz
