// Each setter marks what it changed: the state rebuilt in part equals the state built anew.
#include <functional>

#include "state_fixture.h"

namespace halfspace::state {
namespace {

using raster::BlendFactor;
using raster::DrawState;

bool same(const DrawState& a, const DrawState& b) {
  return a.clip_from_object == b.clip_from_object && a.viewport == b.viewport &&
         a.raster.cull_front == b.raster.cull_front && a.raster.cull_back == b.raster.cull_back &&
         a.raster.front_is_ccw == b.raster.front_is_ccw && a.raster.flat_shading == b.raster.flat_shading &&
         a.raster.scissor_test == b.raster.scissor_test && a.raster.scissor == b.raster.scissor &&
         a.depth == b.depth && a.alpha_test == b.alpha_test && a.blend == b.blend && a.point == b.point &&
         a.line == b.line && a.polygon == b.polygon && a.clip_planes.enabled == b.clip_planes.enabled &&
         a.clip_planes.planes == b.clip_planes.planes && a.color_mask == b.color_mask &&
         a.texture.view == b.texture.view && a.texture.env == b.texture.env &&
         a.texture.env_color == b.texture.env_color && a.texture.matrix == b.texture.matrix &&
         a.texture.matrix_is_identity == b.texture.matrix_is_identity && a.accuracy == b.accuracy;
}

// Where DrawState::rest_version is.
bool rest_is_same(const DrawState& a, DrawState b) {
  b.clip_from_object = a.clip_from_object;
  b.texture.view = a.texture.view;
  b.texture.env = a.texture.env;
  b.texture.env_color = a.texture.env_color;
  return same(a, b);
}

const double kMatrix[16] = {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 1, 2, 3, 1};
const GLint kReplace[] = {GL_REPLACE};
const GLfloat kEnvColor[] = {0.25f, 0.5f, 0.75f, 1};
const GLubyte kTexels[128] = {255, 128};
const GLint kNearest[] = {GL_NEAREST};
const GLint kClamp[] = {GL_CLAMP};

// In order; each changes what is derived.
const std::pair<const char*, std::function<void(Context&)>> kSetters[] = {
    {"load_matrix", [](Context& c) { op::load_matrix(c, kMatrix); }},
    {"mult_matrix", [](Context& c) { op::mult_matrix(c, kMatrix); }},
    {"rotate", [](Context& c) { op::rotate(c, 30, 1, 2, 3); }},
    {"scale", [](Context& c) { op::scale(c, 1, 2, 3); }},
    {"translate", [](Context& c) { op::translate(c, 1, 2, 3); }},
    {"frustum", [](Context& c) { op::frustum(c, -1, 2, -1, 3, 1, 9); }},
    {"ortho", [](Context& c) { op::ortho(c, -1, 2, -1, 3, 1, 9); }},
    {"load_identity", [](Context& c) { op::load_identity(c); }},
    {"under a push",
     [](Context& c) {
       op::scale(c, 2, 2, 2);
       op::push_matrix(c);
       op::translate(c, 1, 0, 0);
     }},
    {"pop_matrix", [](Context& c) { op::pop_matrix(c); }},
    {"projection",
     [](Context& c) {
       op::matrix_mode(c, GL_PROJECTION);
       op::scale(c, 1, 2, 1);
     }},
    {"texture matrix",
     [](Context& c) {
       op::matrix_mode(c, GL_TEXTURE);
       op::push_matrix(c);
       op::scale(c, 5, 1, 1);
     }},
    {"texture pop", [](Context& c) { op::pop_matrix(c); }},
    {"viewport", [](Context& c) { op::viewport(c, 1, 2, 3, 4); }},
    {"depth_range", [](Context& c) { op::depth_range(c, 0.75, 0.25); }},
    {"point_size", [](Context& c) { op::point_size(c, 3); }},
    {"line_width", [](Context& c) { op::line_width(c, 3); }},
    {"line_stipple", [](Context& c) { op::line_stipple(c, 3, 5); }},
    {"polygon_mode", [](Context& c) { op::polygon_mode(c, GL_BACK, GL_LINE); }},
    {"polygon_offset", [](Context& c) { op::polygon_offset(c, 3, 5); }},
    {"polygon_stipple", [](Context& c) { op::polygon_stipple(c, kTexels); }},
    {"clip_plane", [](Context& c) { op::clip_plane(c, GL_CLIP_PLANE1, kMatrix); }},
    {"clip plane", [](Context& c) { op::enable(c, GL_CLIP_PLANE1); }},
    {"scissor", [](Context& c) { op::scissor(c, 1, 2, 3, 4); }},
    {"scissor test", [](Context& c) { op::enable(c, GL_SCISSOR_TEST); }},
    {"cull", [](Context& c) { op::enable(c, GL_CULL_FACE); }},
    {"cull_face", [](Context& c) { op::cull_face(c, GL_FRONT_AND_BACK); }},
    {"front_face", [](Context& c) { op::front_face(c, GL_CW); }},
    {"shade_model", [](Context& c) { op::shade_model(c, GL_FLAT); }},
    {"alpha test", [](Context& c) { op::enable(c, GL_ALPHA_TEST); }},
    {"alpha_func", [](Context& c) { op::alpha_func(c, GL_LEQUAL, 0.5f); }},
    {"blend", [](Context& c) { op::enable(c, GL_BLEND); }},
    {"blend_func", [](Context& c) { op::blend_func(c, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA); }},
    {"depth test", [](Context& c) { op::enable(c, GL_DEPTH_TEST); }},
    {"depth_func", [](Context& c) { op::depth_func(c, GL_NOTEQUAL); }},
    {"depth_mask", [](Context& c) { op::depth_mask(c, GL_FALSE); }},
    {"color_mask", [](Context& c) { op::color_mask(c, 1, 0, 1, 0); }},
    {"blend off", [](Context& c) { op::disable(c, GL_BLEND); }},
    {"tex_env mode", [](Context& c) { op::tex_enviv(c, GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, kReplace); }},
    {"tex_env color", [](Context& c) { op::tex_envfv(c, GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, kEnvColor); }},
    {"a texture",
     [](Context& c) {
       op::enable(c, GL_TEXTURE_2D);
       op::bind_texture(c, GL_TEXTURE_2D, 7);
       op::tex_parameteriv(c, GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, kNearest);
       op::tex_image_2d(c, GL_TEXTURE_2D, 0, GL_RGBA, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, kTexels);
     }},
    {"tex_parameter", [](Context& c) { op::tex_parameteriv(c, GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, kClamp); }},
    {"tex_sub_image",
     [](Context& c) {
       op::tex_sub_image_2d(c, GL_TEXTURE_2D, 0, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, kTexels);
     }},
    {"texture off", [](Context& c) { op::disable(c, GL_TEXTURE_2D); }},
    {"texture on", [](Context& c) { op::enable(c, GL_TEXTURE_2D); }},
    {"another texture", [](Context& c) { op::bind_texture(c, GL_TEXTURE_2D, 8); }},
};

class DeriveTest : public StateTest {};

TEST_F(DeriveTest, PartsEqualTheWhole) {
  for (const auto& [name, set] : kSetters) {
    const auto before = derive(*context);
    set(*context);
    ASSERT_EQ(op::get_error(*context), GLenum(GL_NO_ERROR)) << name;
    const auto after = derive(*context);
    EXPECT_FALSE(same(*before, *after)) << name << " changed nothing";
    EXPECT_TRUE(before->rest_version != after->rest_version || rest_is_same(*before, *after))
        << name << " changed what the version stands for";
    context->derived.dirty = kDirtyAll;
    context->derived.state = nullptr;
    EXPECT_TRUE(same(*derive(*context), *after)) << name << " did not mark all that it changed";
  }
}

TEST_F(DeriveTest, MatricesAndTexturesLeaveTheRestsVersion) {
  op::enable(*context, GL_TEXTURE_2D);
  const uint64_t version = derive(*context)->rest_version;
  EXPECT_NE(version, 0u);
  op::load_matrix(*context, kMatrix);
  op::bind_texture(*context, GL_TEXTURE_2D, 3);
  EXPECT_EQ(derive(*context)->rest_version, version);
  op::depth_func(*context, GL_ALWAYS);
  EXPECT_NE(derive(*context)->rest_version, version);
}

TEST_F(DeriveTest, AStateThatSomebodyHoldsStays) {
  const raster::DrawState* const alone = derive(*context).get();
  op::load_matrix(*context, kMatrix);
  EXPECT_EQ(derive(*context).get(), alone) << "nobody held it";
  const auto held = derive(*context);
  const auto matrix = held->eye_from_object;
  op::load_identity(*context);
  EXPECT_NE(derive(*context), held);
  EXPECT_EQ(held->eye_from_object, matrix);
  EXPECT_NE(derive(*context)->eye_from_object, matrix);
}

TEST_F(DeriveTest, ASharingContextSeesNewTexels) {
  op::enable(*context, GL_TEXTURE_2D);
  op::tex_parameteriv(*context, GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, kNearest);
  op::bind_texture(*context, GL_TEXTURE_2D, 3);
  op::tex_parameteriv(*context, GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, kNearest);
  const auto before = derive(*context);
  EXPECT_EQ(before->texture.view, nullptr);
  Context other({}, context.get());
  op::bind_texture(other, GL_TEXTURE_2D, 3);
  op::tex_image_2d(other, GL_TEXTURE_2D, 0, GL_RGBA, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, kTexels);
  EXPECT_NE(derive(*context)->texture.view, nullptr);
}

TEST_F(DeriveTest, BlendFactorsKeepTheirNames) {
  const std::pair<GLenum, BlendFactor> factors[] = {
      {GL_ZERO, BlendFactor::zero},           {GL_ONE, BlendFactor::one},
      {GL_SRC_COLOR, BlendFactor::src_color}, {GL_ONE_MINUS_SRC_COLOR, BlendFactor::one_minus_src_color},
      {GL_DST_COLOR, BlendFactor::dst_color}, {GL_ONE_MINUS_DST_COLOR, BlendFactor::one_minus_dst_color},
      {GL_SRC_ALPHA, BlendFactor::src_alpha}, {GL_ONE_MINUS_SRC_ALPHA, BlendFactor::one_minus_src_alpha},
      {GL_DST_ALPHA, BlendFactor::dst_alpha}, {GL_ONE_MINUS_DST_ALPHA, BlendFactor::one_minus_dst_alpha},
  };
  for (const auto& [gl, factor] : factors) {
    op::blend_func(*context, gl, GL_ONE);
    EXPECT_EQ(derive(*context)->blend.src, factor);
    op::blend_func(*context, GL_ONE, gl);
    EXPECT_EQ(derive(*context)->blend.dst, factor);
  }
  op::blend_func(*context, GL_SRC_ALPHA_SATURATE, GL_ONE);
  EXPECT_EQ(derive(*context)->blend.src, BlendFactor::src_alpha_saturate);
}

TEST_F(DeriveTest, CompareFunctionsKeepTheirNames) {
  using raster::CompareFunc;
  const std::pair<GLenum, CompareFunc> functions[] = {
      {GL_NEVER, CompareFunc::never},          {GL_LESS, CompareFunc::less},
      {GL_EQUAL, CompareFunc::equal},          {GL_LEQUAL, CompareFunc::less_equal},
      {GL_GREATER, CompareFunc::greater},      {GL_NOTEQUAL, CompareFunc::not_equal},
      {GL_GEQUAL, CompareFunc::greater_equal}, {GL_ALWAYS, CompareFunc::always},
  };
  for (const auto& [gl, function] : functions) {
    op::depth_func(*context, gl);
    op::alpha_func(*context, gl, 0.5f);
    EXPECT_EQ(derive(*context)->depth.func, function);
    EXPECT_EQ(derive(*context)->alpha_test.func, function);
  }
}

}  // namespace
}  // namespace halfspace::state
