// Texture coordinate generation: what is kept, what queries answer, and what a draw gets.
#include <array>

#include "recording_device.h"
#include "state_fixture.h"

namespace halfspace::state {
namespace {

using Plane = std::array<double, 4>;

class TexGenTest : public StateTest {
 protected:
  TexGenTest() { raster::recorded_draws.clear(); }
  Plane plane(GLenum coord, GLenum pname) {
    Plane v{};
    op::get_tex_gendv(*context, coord, pname, v.data());
    return v;
  }
  void set_mode(GLenum coord, GLenum mode) {
    const double value = mode;
    op::tex_gen(*context, coord, GL_TEXTURE_GEN_MODE, &value);
  }
  const raster::RecordedDraw& drawn() {
    op::rect(*context, 0, 0, 1, 1);
    op::flush(*context);
    return raster::recorded_draws.back();
  }
};

TEST_F(TexGenTest, InitialValuesAreTheSpecs) {
  const Plane planes[] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {}, {}};
  for (GLenum i = 0; i < 4; ++i) {
    GLint mode = 0;
    op::get_tex_geniv(*context, GL_S + i, GL_TEXTURE_GEN_MODE, &mode);
    EXPECT_EQ(mode, GL_EYE_LINEAR);
    EXPECT_EQ(plane(GL_S + i, GL_OBJECT_PLANE), planes[i]);
    EXPECT_EQ(plane(GL_S + i, GL_EYE_PLANE), planes[i]);
  }
}

TEST_F(TexGenTest, EyePlanesGoThroughTheInverseModelview) {
  op::translate(*context, 4, 8, 16);
  op::scale(*context, 2, 0.5, 4);
  const Plane given{1, 2, 3, 4};
  op::tex_gen(*context, GL_R, GL_EYE_PLANE, given.data());
  op::tex_gen(*context, GL_R, GL_OBJECT_PLANE, given.data());
  // x = 4 + 2 x', y = 8 + y' / 2, z = 16 + 4 z': x' + 2 y' + 3 z' + 4 in x, y, z.
  EXPECT_EQ(plane(GL_R, GL_EYE_PLANE), (Plane{0.5, 4, 0.75, 4 - 2 - 32 - 12}));
  EXPECT_EQ(plane(GL_R, GL_OBJECT_PLANE), given);
  float floats[4];
  op::get_tex_genfv(*context, GL_R, GL_EYE_PLANE, floats);
  EXPECT_EQ(floats[2], 0.75f);
  GLint integers[4];
  op::get_tex_geniv(*context, GL_R, GL_EYE_PLANE, integers);
  EXPECT_EQ(integers[3], -42);
  op::scale(*context, 0, 1, 1);  // no inverse: the plane as it is
  op::tex_gen(*context, GL_Q, GL_EYE_PLANE, given.data());
  EXPECT_EQ(plane(GL_Q, GL_EYE_PLANE), given);
}

TEST_F(TexGenTest, ADrawGetsWhatIsEnabled) {
  op::enable(*context, GL_TEXTURE_2D);
  EXPECT_FALSE(drawn().state->tex_gen.any());
  const Plane p{1, 2, 3, 4};
  set_mode(GL_T, GL_OBJECT_LINEAR);
  op::tex_gen(*context, GL_T, GL_OBJECT_PLANE, p.data());
  op::enable(*context, GL_TEXTURE_GEN_T);
  op::enable(*context, GL_TEXTURE_GEN_Q);
  const raster::TexGenState& state = drawn().state->tex_gen;
  EXPECT_EQ(state.coord[0].mode, raster::TexGenMode::off);
  EXPECT_EQ(state.coord[1].mode, raster::TexGenMode::object_linear);
  EXPECT_EQ(state.coord[1].object_plane, p);
  EXPECT_EQ(state.coord[3].mode, raster::TexGenMode::eye_linear);
  EXPECT_FALSE(drawn().has_normal);
}

TEST_F(TexGenTest, SphereMapsTakeNormals) {
  op::enable(*context, GL_TEXTURE_2D);
  op::scale(*context, 2, 4, 8);
  set_mode(GL_S, GL_SPHERE_MAP);
  EXPECT_FALSE(drawn().has_normal);
  op::enable(*context, GL_TEXTURE_GEN_S);
  EXPECT_TRUE(drawn().has_normal);
  EXPECT_EQ(drawn().state->tex_gen.coord[0].mode, raster::TexGenMode::sphere_map);
  EXPECT_EQ(drawn().state->normal_from_object[4], 0.25);
  op::disable(*context, GL_TEXTURE_GEN_S);
  EXPECT_FALSE(drawn().has_normal);
}

}  // namespace
}  // namespace halfspace::state
