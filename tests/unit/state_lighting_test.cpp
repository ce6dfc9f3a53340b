// Lights, materials, the light model and colour material: what is kept, what queries answer, and what a draw
// gets.
#include <array>
#include <cmath>

#include "recording_device.h"
#include "state_fixture.h"

namespace halfspace::state {
namespace {

using Four = std::array<float, 4>;

class LightingTest : public StateTest {
 protected:
  LightingTest() { raster::recorded_draws.clear(); }
  Four light(GLenum name, GLenum pname) {
    Four v{};
    op::get_lightfv(*context, name, pname, v.data());
    return v;
  }
  Four material(GLenum face, GLenum pname) {
    Four v{};
    op::get_materialfv(*context, face, pname, v.data());
    return v;
  }
  const raster::LightingState& drawn() {
    op::rect(*context, 0, 0, 1, 1);
    op::flush(*context);
    return raster::recorded_draws.back().state->lighting;
  }
};

TEST_F(LightingTest, InitialValuesAreTheSpecs) {
  for (GLenum i = 0; i < 8; ++i) {
    const Four color = i == 0 ? Four{1, 1, 1, 1} : Four{0, 0, 0, 1};
    EXPECT_EQ(light(GL_LIGHT0 + i, GL_AMBIENT), (Four{0, 0, 0, 1}));
    EXPECT_EQ(light(GL_LIGHT0 + i, GL_DIFFUSE), color);
    EXPECT_EQ(light(GL_LIGHT0 + i, GL_SPECULAR), color);
    EXPECT_EQ(light(GL_LIGHT0 + i, GL_POSITION), (Four{0, 0, 1, 0}));
    EXPECT_EQ(light(GL_LIGHT0 + i, GL_SPOT_DIRECTION), (Four{0, 0, -1, 0}));
    EXPECT_EQ(light(GL_LIGHT0 + i, GL_SPOT_EXPONENT)[0], 0);
    EXPECT_EQ(light(GL_LIGHT0 + i, GL_SPOT_CUTOFF)[0], 180);
    EXPECT_EQ(light(GL_LIGHT0 + i, GL_CONSTANT_ATTENUATION)[0], 1);
    EXPECT_EQ(light(GL_LIGHT0 + i, GL_LINEAR_ATTENUATION)[0], 0);
    EXPECT_EQ(light(GL_LIGHT0 + i, GL_QUADRATIC_ATTENUATION)[0], 0);
  }
  for (GLenum face : std::initializer_list<GLenum>{GL_FRONT, GL_BACK}) {
    EXPECT_EQ(material(face, GL_AMBIENT), (Four{0.2f, 0.2f, 0.2f, 1}));
    EXPECT_EQ(material(face, GL_DIFFUSE), (Four{0.8f, 0.8f, 0.8f, 1}));
    EXPECT_EQ(material(face, GL_SPECULAR), (Four{0, 0, 0, 1}));
    EXPECT_EQ(material(face, GL_EMISSION), (Four{0, 0, 0, 1}));
    EXPECT_EQ(material(face, GL_SHININESS)[0], 0);
    EXPECT_EQ(material(face, GL_COLOR_INDEXES), (Four{0, 1, 1, 0}));
  }
}

TEST_F(LightingTest, PositionsAndDirectionsGoThroughTheModelview) {
  op::translate(*context, 10, 20, 30);
  op::scale(*context, 2, 3, 4);
  const Four position{1, 1, 1, 0.5f}, direction{1, -1, 1, 77};
  op::light(*context, GL_LIGHT5, GL_POSITION, position.data());
  op::light(*context, GL_LIGHT5, GL_SPOT_DIRECTION, direction.data());
  op::load_identity(*context);
  EXPECT_EQ(light(GL_LIGHT5, GL_POSITION), (Four{7, 13, 19, 0.5f}));
  EXPECT_EQ(light(GL_LIGHT5, GL_SPOT_DIRECTION), (Four{2, -3, 4, 0}));
}

TEST_F(LightingTest, QueriesConvertAsTheirKindsSay) {
  const Four color{1, -1, 0, 0.5f}, place{1.5f, -2.5f, 0.25f, 1}, cutoff{44.6f};
  op::light(*context, GL_LIGHT2, GL_SPECULAR, color.data());
  op::light(*context, GL_LIGHT2, GL_POSITION, place.data());
  op::light(*context, GL_LIGHT2, GL_SPOT_CUTOFF, cutoff.data());
  op::material(*context, GL_BACK, GL_EMISSION, color.data());
  op::material(*context, GL_BACK, GL_SHININESS, cutoff.data());
  const std::array<GLint, 4> integers{INT32_MAX, INT32_MIN, 0, 1073741823};
  std::array<GLint, 4> v{};
  op::get_lightiv(*context, GL_LIGHT2, GL_SPECULAR, v.data());
  EXPECT_EQ(v, integers);
  op::get_materialiv(*context, GL_BACK, GL_EMISSION, v.data());
  EXPECT_EQ(v, integers);
  op::get_lightiv(*context, GL_LIGHT2, GL_POSITION, v.data());
  EXPECT_EQ(v, (std::array<GLint, 4>{2, -2, 0, 1}));
  op::get_lightiv(*context, GL_LIGHT2, GL_SPOT_CUTOFF, v.data());
  EXPECT_EQ(v[0], 45);
  op::get_materialiv(*context, GL_BACK, GL_SHININESS, v.data());
  EXPECT_EQ(v[0], 45);
}

TEST_F(LightingTest, ADrawGetsWhatIsSet) {
  EXPECT_FALSE(drawn().enabled);
  const Four ambient{0.1f, 0.2f, 0.3f, 0.4f}, yes{1}, cutoff{60};
  op::enable(*context, GL_LIGHTING);
  op::enable(*context, GL_LIGHT3);
  op::light(*context, GL_LIGHT3, GL_SPOT_CUTOFF, cutoff.data());
  op::light_model(*context, GL_LIGHT_MODEL_AMBIENT, ambient.data());
  op::light_model(*context, GL_LIGHT_MODEL_LOCAL_VIEWER, yes.data());
  op::light_model(*context, GL_LIGHT_MODEL_TWO_SIDE, yes.data());
  op::material(*context, GL_BACK, GL_DIFFUSE, ambient.data());
  const raster::LightingState& state = drawn();
  EXPECT_TRUE(state.enabled && state.local_viewer && state.two_sided);
  EXPECT_TRUE(state.lights[3].enabled && !state.lights[0].enabled);
  EXPECT_NEAR(state.lights[3].spot_cosine, 0.5, 1e-15);
  EXPECT_EQ(state.model_ambient, (raster::Color{0.1f, 0.2f, 0.3f, 0.4f}));
  EXPECT_EQ(state.material.back.diffuse, (raster::Color{0.1f, 0.2f, 0.3f, 0.4f}));
  EXPECT_EQ(state.material.front.diffuse, (raster::Color{0.8f, 0.8f, 0.8f, 1}));
  GLint on = 0;
  op::get_integerv(*context, GL_LIGHT_MODEL_TWO_SIDE, &on);
  EXPECT_EQ(on, 1);
}

TEST_F(LightingTest, NormalsGoByTheInverseTranspose) {
  op::enable(*context, GL_LIGHTING);
  op::rotate(*context, 90, 0, 0, 1);
  op::scale(*context, 2, 4, 8);
  drawn();
  const auto& n = raster::recorded_draws.back().state->normal_from_object;
  // (x, y, z) -> (-y / 4, x / 2, z / 8)
  const std::array<double, 9> expected{0, 0.5, 0, -0.25, 0, 0, 0, 0, 0.125};
  EXPECT_EQ(n, expected);
  EXPECT_FALSE(raster::recorded_draws.back().state->normalize);
  op::enable(*context, GL_NORMALIZE);
  op::scale(*context, 1, 0, 1);  // no inverse any more: still finite, and the flat side's normal
  drawn();
  const auto& flat = raster::recorded_draws.back().state->normal_from_object;
  for (double v : flat) EXPECT_TRUE(std::isfinite(v));
  EXPECT_NE(flat[3], 0);
  EXPECT_EQ(flat[0], 0);
  EXPECT_TRUE(raster::recorded_draws.back().state->normalize);
}

TEST_F(LightingTest, ColourMaterialFollowsTheColour) {
  op::color_material(*context, GL_BACK, GL_SPECULAR);
  op::color(*context, 0.25f, 2, -1, 0.5f);
  EXPECT_EQ(material(GL_BACK, GL_SPECULAR), (Four{0, 0, 0, 1}));
  op::enable(*context, GL_COLOR_MATERIAL);
  EXPECT_EQ(material(GL_BACK, GL_SPECULAR), (Four{0.25f, 2, -1, 0.5f}));
  EXPECT_EQ(material(GL_FRONT, GL_SPECULAR), (Four{0, 0, 0, 1}));
  op::color(*context, 0.5f, 0, 0, 1);
  const Four other{9, 9, 9, 9};
  op::material(*context, GL_FRONT_AND_BACK, GL_SPECULAR, other.data());  // not what follows the colour
  EXPECT_EQ(material(GL_BACK, GL_SPECULAR), (Four{0.5f, 0, 0, 1}));
  EXPECT_EQ(material(GL_FRONT, GL_SPECULAR), other);
  // What stops following keeps its last value: by another mode, and by being turned off.
  op::color(*context, 0.75f, 0, 0, 1);
  op::color_material(*context, GL_FRONT, GL_AMBIENT_AND_DIFFUSE);
  op::color(*context, 0, 1, 0, 1);
  EXPECT_EQ(material(GL_BACK, GL_SPECULAR), (Four{0.75f, 0, 0, 1}));
  EXPECT_EQ(material(GL_FRONT, GL_AMBIENT), (Four{0, 1, 0, 1}));
  op::color(*context, 0, 0, 1, 1);
  op::disable(*context, GL_COLOR_MATERIAL);
  op::color(*context, 1, 1, 1, 1);
  EXPECT_EQ(material(GL_FRONT, GL_DIFFUSE), (Four{0, 0, 1, 1}));
  EXPECT_EQ(material(GL_BACK, GL_DIFFUSE), (Four{0.8f, 0.8f, 0.8f, 1}));
}

TEST_F(LightingTest, ADrawIsToldWhatFollowsTheColour) {
  op::enable(*context, GL_LIGHTING);
  op::enable(*context, GL_COLOR_MATERIAL);
  for (auto [mode, bits] : {std::pair{GL_AMBIENT, 1},
                            {GL_DIFFUSE, 2},
                            {GL_SPECULAR, 4},
                            {GL_EMISSION, 8},
                            {GL_AMBIENT_AND_DIFFUSE, 3}}) {
    for (auto [face, sides] : {std::pair{GL_FRONT, 1}, {GL_BACK, 2}, {GL_FRONT_AND_BACK, 3}}) {
      op::color_material(*context, GLenum(face), GLenum(mode));
      const raster::LightingState& state = drawn();
      const auto bits_of = [](const raster::LightingState::ColorMaterial& m) {
        return m.ambient + 2 * m.diffuse + 4 * m.specular + 8 * m.emission;
      };
      EXPECT_EQ(bits_of(state.color_material_front), sides & 1 ? bits : 0);
      EXPECT_EQ(bits_of(state.color_material_back), sides & 2 ? bits : 0);
    }
  }
  op::disable(*context, GL_COLOR_MATERIAL);
  EXPECT_FALSE(drawn().color_material_front.any());
}

}  // namespace
}  // namespace halfspace::state
