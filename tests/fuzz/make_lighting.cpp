// Lighting, materials and generated texture coordinates: all at the corners, and not linear between them.
#include "maker.h"

namespace halfspace::fuzz {
namespace {

double some_light(Maker& m) { return GL_LIGHT0 + m.random.below(m.random.chance(70) ? 2 : 8); }

void add_light(Maker& m) {
  m.lose_linearity();
  const double light = some_light(m);
  m.set_enabled(GL_LIGHTING, m.random.chance(90));
  m.set_enabled(static_cast<GLenum>(light), m.random.chance(85));
  for (double name : {GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR}) {
    if (m.random.chance(50)) m.call(Command::glLightfv, {light, name, 0}, m.color());
  }
  if (m.random.chance(70)) {
    m.call(Command::glLightfv, {light, GL_POSITION, 0},
           std::vector<float>{float(m.random.real(-2, 2)), float(m.random.real(-2, 2)),
                              float(m.random.real(0.5, 2)), float(m.random.below(2))});
  }
}

void add_spot(Maker& m) {
  m.lose_linearity();
  const double light = some_light(m);
  m.call(Command::glLightf, {light, GL_SPOT_CUTOFF, m.random.chance(20) ? 180 : m.random.real(20, 90)});
  m.call(Command::glLightf, {light, GL_SPOT_EXPONENT, m.random.chance(30) ? 0 : m.random.real(0, 20)});
  m.call(Command::glLightfv, {light, GL_SPOT_DIRECTION, 0},
         std::vector<float>{float(m.random.real(-1, 1)), float(m.random.real(-1, 1)), -1});
}

void add_attenuation(Maker& m) {
  m.lose_linearity();
  const double name =
      m.random.pick({GL_CONSTANT_ATTENUATION, GL_LINEAR_ATTENUATION, GL_QUADRATIC_ATTENUATION});
  m.call(Command::glLightf, {some_light(m), name, m.random.real(0.25, 1)});
}

void add_light_model(Maker& m) {
  m.lose_linearity();
  switch (m.random.below(3)) {
    case 0:
      m.call(Command::glLightModelfv, {GL_LIGHT_MODEL_AMBIENT, 0}, m.color());
      break;
    case 1:
      m.call(Command::glLightModeli, {GL_LIGHT_MODEL_LOCAL_VIEWER, double(m.random.below(2))});
      break;
    default:
      m.call(Command::glLightModeli, {GL_LIGHT_MODEL_TWO_SIDE, double(m.random.below(2))});
  }
}

void add_material(Maker& m) {
  m.lose_linearity();
  const double face = m.random.pick({GL_FRONT, GL_BACK, GL_FRONT_AND_BACK});
  if (m.random.chance(30)) {
    m.call(Command::glMaterialf, {face, GL_SHININESS, double(m.random.between(0, 128))});
  } else {
    m.call(Command::glMaterialfv,
           {face,
            double(m.random.pick({GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION, GL_AMBIENT_AND_DIFFUSE})),
            0},
           m.color());
  }
}

void add_color_material(Maker& m) {
  m.lose_linearity();
  m.call(Command::glColorMaterial,
         {double(m.random.pick({GL_FRONT, GL_BACK, GL_FRONT_AND_BACK})),
          double(m.random.pick({GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION, GL_AMBIENT_AND_DIFFUSE}))});
  m.set_enabled(GL_COLOR_MATERIAL, m.random.chance(80));
}

void add_normalize(Maker& m) { m.set_enabled(GL_NORMALIZE, m.random.chance(75)); }

void add_tex_gen(Maker& m) {
  m.lose_linearity();
  const double coordinate = m.random.pick({GL_S, GL_T, GL_S, GL_T, GL_R, GL_Q});
  // A generated q near zero would be a division by it; a sphere has s and t only.
  double mode = m.random.pick({GL_OBJECT_LINEAR, GL_EYE_LINEAR, GL_SPHERE_MAP});
  if (coordinate == GL_R || coordinate == GL_Q) mode = GL_OBJECT_LINEAR;
  m.call(Command::glTexGeni, {coordinate, GL_TEXTURE_GEN_MODE, mode});
  if (mode != GL_SPHERE_MAP) {
    std::vector<float> plane;
    for (int i = 0; i < 4; ++i) plane.push_back(float(m.random.real(-1, 1)));
    if (coordinate == GL_Q) plane = {0, 0, 0, 1};
    m.call(Command::glTexGenfv,
           {coordinate, double(mode == GL_OBJECT_LINEAR ? GL_OBJECT_PLANE : GL_EYE_PLANE), 0}, plane);
  }
  m.set_enabled(GL_TEXTURE_GEN_S + static_cast<GLenum>(coordinate) - GL_S, m.random.chance(80));
}

}  // namespace

const std::vector<Feature>& lighting_features() {
  static const std::vector<Feature> kFeatures = {
      {.group = "light", .add = add_light, .weight = 4, .exact = false},
      {.group = "light", .add = add_spot, .exact = false},
      {.group = "light", .add = add_attenuation, .exact = false},
      {.group = "light", .add = add_light_model, .exact = false},
      {.group = "light", .add = add_material, .weight = 2, .exact = false},
      {.group = "light", .add = add_color_material, .exact = false},
      {.group = "light", .add = add_normalize, .exact = false},
      {.group = "tex_gen", .add = add_tex_gen, .weight = 2, .exact = false},
  };
  return kFeatures;
}

}  // namespace halfspace::fuzz
