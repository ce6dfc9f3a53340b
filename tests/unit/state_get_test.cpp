// The query table, and the conversions of spec 6.1.2.
#include <cmath>
#include <set>
#include <string_view>

#include "state_fixture.h"

namespace halfspace::state {
namespace {

class GetTest : public StateTest {
 protected:
  GetTest() : StateTest(double_buffered(), 71, 53) {}
  GLint integer(GLenum name) {
    GLint v[16] = {};
    op::get_integerv(*context, name, v);
    EXPECT_EQ(op::get_error(*context), GLenum(GL_NO_ERROR)) << std::hex << name;
    return v[0];
  }
  template <size_t kCount>
  std::array<GLint, kCount> integers(GLenum name) {
    GLint v[16] = {};
    op::get_integerv(*context, name, v);
    std::array<GLint, kCount> out;
    std::copy_n(v, kCount, out.begin());
    return out;
  }
};

TEST_F(GetTest, RowsAreSortedAndWriteWhatTheySay) {
  GLenum last = 0;
  for (const GetRow& row : all_get_rows()) {
    EXPECT_GT(row.name, last);
    last = row.name;
    ASSERT_LE(row.count, kMaxGetValues);
    // Twice, over two backgrounds: values beyond `count` stay, values below it do not depend on what was
    // there.
    double a[kMaxGetValues + 1], b[kMaxGetValues + 1];
    std::fill(std::begin(a), std::end(a), 12345.5);
    std::fill(std::begin(b), std::end(b), -54321.5);
    row.read(*context, a);
    row.read(*context, b);
    for (int i = 0; i <= kMaxGetValues; ++i) {
      if (i < row.count) {
        EXPECT_EQ(a[i], b[i]) << std::hex << row.name;
      } else {
        EXPECT_EQ(a[i], 12345.5) << std::hex << row.name;
      }
    }
  }
}

TEST_F(GetTest, AllFourQueriesAgree) {
  for (const GetRow& row : all_get_rows()) {
    GLboolean booleans[16];
    GLint integers_[16];
    GLfloat floats[16];
    GLdouble doubles[16];
    op::get_booleanv(*context, row.name, booleans);
    op::get_integerv(*context, row.name, integers_);
    op::get_floatv(*context, row.name, floats);
    op::get_doublev(*context, row.name, doubles);
    for (int i = 0; i < row.count; ++i) {
      EXPECT_EQ(booleans[i], doubles[i] != 0 ? GL_TRUE : GL_FALSE) << std::hex << row.name;
      EXPECT_EQ(floats[i], float(doubles[i])) << std::hex << row.name;
      if (row.kind != GetKind::normalized && std::fabs(doubles[i]) < 1e9) {
        EXPECT_LE(std::fabs(doubles[i] - integers_[i]), 0.5) << std::hex << row.name;
      }
    }
  }
}

TEST_F(GetTest, NormalizedValuesSpanTheIntegers) {
  op::color(*context, 1, -1, 0, 0.5f);
  EXPECT_EQ(integers<4>(GL_CURRENT_COLOR), (std::array<GLint, 4>{INT32_MAX, INT32_MIN, 0, 1073741823}));
  op::color(*context, 2, -2, NAN, INFINITY);  // current colours are not clamped; what an int cannot say, is
  EXPECT_EQ(integers<4>(GL_CURRENT_COLOR), (std::array<GLint, 4>{INT32_MAX, INT32_MIN, 0, INT32_MAX}));
  op::depth_range(*context, 0, 1);
  EXPECT_EQ(integers<2>(GL_DEPTH_RANGE), (std::array<GLint, 2>{0, INT32_MAX}));
}

TEST_F(GetTest, PlainValuesRoundToTheNearest) {
  op::tex_coord(*context, 1.5f, -1.75f, 0.25f, 1e20f);
  EXPECT_EQ(integers<4>(GL_CURRENT_TEXTURE_COORDS), (std::array<GLint, 4>{2, -2, 0, INT32_MAX}));
  op::translate(*context, -2.6, 0, 0);
  EXPECT_EQ(integers<16>(GL_MODELVIEW_MATRIX)[12], -3);
}

TEST_F(GetTest, BooleansAndMasks) {
  EXPECT_EQ(integers<4>(GL_COLOR_WRITEMASK), (std::array<GLint, 4>{1, 1, 1, 1}));
  op::color_mask(*context, 0, 7, 0, 1);
  EXPECT_EQ(integers<4>(GL_COLOR_WRITEMASK), (std::array<GLint, 4>{0, 1, 0, 1}));
  EXPECT_EQ(integer(GL_STENCIL_WRITEMASK), -1);  // all ones
}

// Every capability: off (GL_DITHER on) at first, and the same by glIsEnabled and by glGet after each change.
TEST_F(GetTest, CapabilitiesAreKept) {
  for (const Capability& capability : all_capabilities()) {
    EXPECT_EQ(op::is_enabled(*context, capability.name), capability.name == GL_DITHER) << capability.text;
    for (GLboolean on : {GLboolean{GL_TRUE}, GLboolean{GL_FALSE}, GLboolean{GL_TRUE}}) {
      (on ? op::enable : op::disable)(*context, capability.name);
      EXPECT_EQ(op::is_enabled(*context, capability.name), on) << capability.text;
      EXPECT_EQ(integer(capability.name), on) << capability.text;
    }
  }
  EXPECT_EQ(op::get_error(*context), GLenum(GL_NO_ERROR));
}

TEST_F(GetTest, InitialValuesAreTheSpecs) {
  const std::pair<GLenum, GLint> expected[] = {
      {GL_MATRIX_MODE, GL_MODELVIEW},
      {GL_SHADE_MODEL, GL_SMOOTH},
      {GL_CULL_FACE_MODE, GL_BACK},
      {GL_FRONT_FACE, GL_CCW},
      {GL_POLYGON_MODE, GL_FILL},
      {GL_DEPTH_FUNC, GL_LESS},
      {GL_DEPTH_WRITEMASK, 1},
      {GL_DEPTH_CLEAR_VALUE, INT32_MAX},
      {GL_ALPHA_TEST_FUNC, GL_ALWAYS},
      {GL_ALPHA_TEST_REF, 0},
      {GL_BLEND_SRC, GL_ONE},
      {GL_BLEND_DST, GL_ZERO},
      {GL_DRAW_BUFFER, GL_BACK},
      {GL_READ_BUFFER, GL_BACK},
      {GL_DOUBLEBUFFER, 1},
      {GL_SUBPIXEL_BITS, 8},
      {GL_DEPTH_BITS, 24},
      {GL_PERSPECTIVE_CORRECTION_HINT, GL_DONT_CARE},
      {GL_VERTEX_ARRAY, 0},
      {GL_VERTEX_ARRAY_SIZE, 4},
      {GL_VERTEX_ARRAY_TYPE, GL_FLOAT},
      {GL_NORMAL_ARRAY_TYPE, GL_FLOAT},
      {GL_MODELVIEW_STACK_DEPTH, 1},
      {GL_EDGE_FLAG, 1},
      {GL_RENDER_MODE, GL_RENDER},
  };
  for (const auto& [name, value] : expected) EXPECT_EQ(integer(name), value) << std::hex << name;
  EXPECT_EQ(integers<4>(GL_VIEWPORT), (std::array<GLint, 4>{0, 0, 71, 53}));
  EXPECT_EQ(integers<4>(GL_SCISSOR_BOX), (std::array<GLint, 4>{0, 0, 71, 53}));
}

TEST_F(GetTest, SettersAreReadBack) {
  op::viewport(*context, -3, 4, 100000, 6);
  EXPECT_EQ(integers<4>(GL_VIEWPORT), (std::array<GLint, 4>{-3, 4, integers<2>(GL_MAX_VIEWPORT_DIMS)[0], 6}));
  op::scissor(*context, 1, 2, 3, 4);
  EXPECT_EQ(integers<4>(GL_SCISSOR_BOX), (std::array<GLint, 4>{1, 2, 3, 4}));
  op::polygon_mode(*context, GL_BACK, GL_LINE);
  EXPECT_EQ(integers<2>(GL_POLYGON_MODE), (std::array<GLint, 2>{GL_FILL, GL_LINE}));
  op::polygon_mode(*context, GL_FRONT, GL_POINT);
  EXPECT_EQ(integers<2>(GL_POLYGON_MODE), (std::array<GLint, 2>{GL_POINT, GL_LINE}));
  op::polygon_mode(*context, GL_FRONT_AND_BACK, GL_FILL);
  EXPECT_EQ(integers<2>(GL_POLYGON_MODE), (std::array<GLint, 2>{GL_FILL, GL_FILL}));
  op::cull_face(*context, GL_FRONT_AND_BACK);
  EXPECT_EQ(integer(GL_CULL_FACE_MODE), GL_FRONT_AND_BACK);
  op::front_face(*context, GL_CW);
  EXPECT_EQ(integer(GL_FRONT_FACE), GL_CW);
  op::blend_func(*context, GL_DST_ALPHA, GL_ONE_MINUS_SRC_COLOR);
  EXPECT_EQ(integer(GL_BLEND_SRC), GL_DST_ALPHA);
  EXPECT_EQ(integer(GL_BLEND_DST), GL_ONE_MINUS_SRC_COLOR);
  op::alpha_func(*context, GL_GREATER, 2);
  EXPECT_EQ(integer(GL_ALPHA_TEST_FUNC), GL_GREATER);
  EXPECT_EQ(integer(GL_ALPHA_TEST_REF), INT32_MAX);
  op::hint(*context, GL_LINE_SMOOTH_HINT, GL_NICEST);
  EXPECT_EQ(integer(GL_LINE_SMOOTH_HINT), GL_NICEST);
  op::clear_depth(*context, -1);
  EXPECT_EQ(integer(GL_DEPTH_CLEAR_VALUE), 0);
  op::clear_color(*context, 2, NAN, -1, 1);
  EXPECT_EQ(integers<4>(GL_COLOR_CLEAR_VALUE), (std::array<GLint, 4>{INT32_MAX, 0, 0, INT32_MAX}));
  op::clear_stencil(*context, 77);
  EXPECT_EQ(integer(GL_STENCIL_CLEAR_VALUE), 77);
  op::stencil_func(*context, GL_GREATER, -5, 0x12345678);
  EXPECT_EQ(integer(GL_STENCIL_FUNC), GL_GREATER);
  EXPECT_EQ(integer(GL_STENCIL_REF), 0);
  EXPECT_EQ(integer(GL_STENCIL_VALUE_MASK), 0x12345678);
  op::stencil_op(*context, GL_INCR, GL_DECR, GL_INVERT);
  EXPECT_EQ(integer(GL_STENCIL_FAIL), GL_INCR);
  EXPECT_EQ(integer(GL_STENCIL_PASS_DEPTH_FAIL), GL_DECR);
  EXPECT_EQ(integer(GL_STENCIL_PASS_DEPTH_PASS), GL_INVERT);
  op::stencil_mask(*context, 0xf0);
  EXPECT_EQ(integer(GL_STENCIL_WRITEMASK), 0xf0);
  op::logic_op(*context, GL_NAND);
  EXPECT_EQ(integer(GL_LOGIC_OP_MODE), GL_NAND);
  op::clear_accum(*context, 2, -2, 0, 1);
  EXPECT_EQ(integers<4>(GL_ACCUM_CLEAR_VALUE), (std::array<GLint, 4>{INT32_MAX, INT32_MIN, 0, INT32_MAX}));
  const auto set_fog = [this](GLenum name, std::array<float, 4> values) { op::fog(*context, name, values.data()); };
  set_fog(GL_FOG_MODE, {float(GL_LINEAR)});
  EXPECT_EQ(integer(GL_FOG_MODE), GL_LINEAR);
  set_fog(GL_FOG_COLOR, {2, -1, 0, 1});
  EXPECT_EQ(integers<4>(GL_FOG_COLOR), (std::array<GLint, 4>{INT32_MAX, 0, 0, INT32_MAX}));
  set_fog(GL_FOG_START, {-7});
  set_fog(GL_FOG_END, {70.6f});
  set_fog(GL_FOG_DENSITY, {3});
  set_fog(GL_FOG_INDEX, {9});
  EXPECT_EQ(integer(GL_FOG_START), -7);
  EXPECT_EQ(integer(GL_FOG_END), 71);
  EXPECT_EQ(integer(GL_FOG_DENSITY), 3);
  EXPECT_EQ(integer(GL_FOG_INDEX), 9);
  op::draw_buffer(*context, GL_FRONT_AND_BACK);
  EXPECT_EQ(integer(GL_DRAW_BUFFER), GL_FRONT_AND_BACK);
  op::depth_mask(*context, GL_FALSE);
  EXPECT_EQ(integer(GL_DEPTH_WRITEMASK), 0);
  EXPECT_EQ(op::get_error(*context), GLenum(GL_NO_ERROR));
}

TEST_F(GetTest, MaterialsKeepTheirFaces) {
  const float red[] = {1, 0, 0, 1}, shiny[] = {128};
  op::material(*context, GL_BACK, GL_AMBIENT_AND_DIFFUSE, red);
  op::material(*context, GL_FRONT, GL_SHININESS, shiny);
  const MaterialState *front = &context->lighting.material[0], *back = &context->lighting.material[1];
  EXPECT_EQ(back->ambient[0], 1);
  EXPECT_EQ(back->diffuse[1], 0);
  EXPECT_EQ(back->shininess, 0);
  EXPECT_EQ(front->diffuse[0], 0.8f);
  EXPECT_EQ(front->shininess, 128);
}

TEST_F(GetTest, Strings) {
  const auto text = [this](GLenum name) {
    return std::string_view(reinterpret_cast<const char*>(op::get_string(*context, name)));
  };
  EXPECT_EQ(text(GL_VENDOR), "Halfspace");
  EXPECT_TRUE(text(GL_RENDERER).starts_with("Halfspace "));
  EXPECT_TRUE(text(GL_VERSION).starts_with("1.1 Halfspace "));
  EXPECT_NE((" " + std::string(text(GL_EXTENSIONS)) + " ").find(" GL_EXT_bgra "), std::string::npos);
}

}  // namespace
}  // namespace halfspace::state
