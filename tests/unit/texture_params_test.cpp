// glTexParameter, glTexEnv, their queries, and completeness (spec 3.8.4, 3.8.10, 3.8.13).
#include <cmath>
#include <limits>

#include "tests/unit/pixel_fixture.h"

namespace halfspace::state {
namespace {

class TextureParamsTest : public PixelTest {
 protected:
  void set(GLenum pname, GLint value, GLenum target = GL_TEXTURE_2D) {
    op::tex_parameteriv(gl(), target, pname, &value);
  }
  GLint get(GLenum pname, GLenum target = GL_TEXTURE_2D) {
    GLint value = -77;
    op::get_tex_parameteriv(gl(), target, pname, &value);
    return value;
  }
  void image(GLint level, GLsizei width, GLsizei height, GLint internal_format = GL_RGBA, GLint border = 0) {
    op::tex_image_2d(gl(), GL_TEXTURE_2D, level, internal_format, width, height, border, GL_RGBA,
                     GL_UNSIGNED_BYTE, nullptr);
    EXPECT_GL(GL_NO_ERROR);
  }
  int view_levels() {
    const auto view = current_texture_view(gl());
    return view == nullptr ? 0 : view->level_count;
  }
};

TEST_F(TextureParamsTest, StartAsTheSpecSays) {
  EXPECT_EQ(get(GL_TEXTURE_MIN_FILTER), GL_NEAREST_MIPMAP_LINEAR);
  EXPECT_EQ(get(GL_TEXTURE_MAG_FILTER), GL_LINEAR);
  EXPECT_EQ(get(GL_TEXTURE_WRAP_S), GL_REPEAT);
  EXPECT_EQ(get(GL_TEXTURE_WRAP_T), GL_REPEAT);
  EXPECT_EQ(get(GL_TEXTURE_PRIORITY), std::numeric_limits<GLint>::max());  // 1.0
  EXPECT_EQ(get(GL_TEXTURE_RESIDENT), 1);
  GLfloat border[4] = {9, 9, 9, 9};
  op::get_tex_parameterfv(gl(), GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border);
  for (GLfloat v : border) EXPECT_EQ(v, 0.0f);
  EXPECT_GL(GL_NO_ERROR);
}

TEST_F(TextureParamsTest, EveryLegalValueIsKeptPerTexture) {
  const std::pair<GLenum, std::vector<GLint>> kLegal[] = {
      {GL_TEXTURE_MIN_FILTER,
       {GL_NEAREST, GL_LINEAR, GL_NEAREST_MIPMAP_NEAREST, GL_LINEAR_MIPMAP_NEAREST, GL_NEAREST_MIPMAP_LINEAR,
        GL_LINEAR_MIPMAP_LINEAR}},
      {GL_TEXTURE_MAG_FILTER, {GL_NEAREST, GL_LINEAR}},
      {GL_TEXTURE_WRAP_S, {GL_REPEAT, GL_CLAMP, GL_CLAMP_TO_EDGE}},
      {GL_TEXTURE_WRAP_T, {GL_REPEAT, GL_CLAMP, GL_CLAMP_TO_EDGE}}};
  for (const auto& [pname, values] : kLegal) {
    for (GLint value : values) {
      set(pname, value);
      EXPECT_EQ(get(pname), value);
      const GLfloat as_float = GLfloat(values[0]);
      op::tex_parameterfv(gl(), GL_TEXTURE_1D, pname, &as_float);
      EXPECT_EQ(get(pname, GL_TEXTURE_1D), values[0]);
      EXPECT_EQ(get(pname), value);
      EXPECT_GL(GL_NO_ERROR);
    }
  }
}

TEST_F(TextureParamsTest, RefusesAndKeeps) {
  const std::pair<GLenum, GLint> kIllegal[] = {{GL_TEXTURE_MIN_FILTER, GL_REPEAT},
                                               {GL_TEXTURE_MAG_FILTER, GL_LINEAR_MIPMAP_LINEAR},
                                               {GL_TEXTURE_WRAP_S, GL_NEAREST},
                                               {GL_TEXTURE_WRAP_T, 0},
                                               {GL_TEXTURE_WRAP_T, -1},
                                               {GL_TEXTURE_BASE_LEVEL, 0},
                                               {GL_TEXTURE_MAX_LEVEL, 0},
                                               {GL_TEXTURE_RESIDENT, 1},
                                               {GL_TEXTURE_WRAP_R, GL_REPEAT},
                                               {GL_TEXTURE_ENV_MODE, GL_MODULATE}};
  for (const auto& [pname, value] : kIllegal) {
    set(pname, value);
    EXPECT_GL(GL_INVALID_ENUM) << std::hex << pname;
    const GLfloat as_float = GLfloat(value);
    op::tex_parameterfv(gl(), GL_TEXTURE_2D, pname, &as_float);
    EXPECT_GL(GL_INVALID_ENUM) << std::hex << pname;
  }
  for (GLfloat value :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e30f}) {
    op::tex_parameterfv(gl(), GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, &value);
    EXPECT_GL(GL_INVALID_ENUM);
  }
  set(GL_TEXTURE_MIN_FILTER, GL_NEAREST, GL_PROXY_TEXTURE_2D);
  EXPECT_GL(GL_INVALID_ENUM);
  EXPECT_EQ(get(GL_TEXTURE_MAX_LEVEL), -77);
  EXPECT_GL(GL_INVALID_ENUM);
  EXPECT_EQ(get(GL_TEXTURE_WRAP_S, GL_TEXTURE_ENV), -77);
  EXPECT_GL(GL_INVALID_ENUM);
  EXPECT_EQ(get(GL_TEXTURE_MIN_FILTER), GL_NEAREST_MIPMAP_LINEAR);
  EXPECT_EQ(get(GL_TEXTURE_MAG_FILTER), GL_LINEAR);
  EXPECT_EQ(get(GL_TEXTURE_WRAP_S), GL_REPEAT);
  EXPECT_EQ(get(GL_TEXTURE_WRAP_T), GL_REPEAT);
}

// Integers of a colour are linear: 2^31 - 1 is 1.0 (table 2.9); other numbers are clamped to [0, 1].
TEST_F(TextureParamsTest, ColoursConvertBothWays) {
  constexpr GLint kMax = std::numeric_limits<GLint>::max(), kMin = std::numeric_limits<GLint>::min();
  const GLint integers[4] = {kMax, 0, kMax / 2, kMin};
  const GLfloat floats[4] = {2.0f, -1.0f, 0.25f, std::numeric_limits<float>::quiet_NaN()};
  GLfloat read[4];
  GLint read_integers[4];
  const auto check = [&](auto&& set_iv, auto&& set_fv, auto&& get_fv, auto&& get_iv) {
    set_iv(integers);
    get_fv(read);
    EXPECT_EQ(read[0], 1.0f);
    EXPECT_NEAR(read[1], 0, 1e-9);
    EXPECT_NEAR(read[2], 0.5, 1e-7);
    EXPECT_EQ(read[3], 0.0f);
    set_fv(floats);
    get_fv(read);
    EXPECT_EQ(read[0], 1.0f);
    EXPECT_EQ(read[1], 0.0f);
    EXPECT_EQ(read[2], 0.25f);
    EXPECT_EQ(read[3], 0.0f);
    get_iv(read_integers);
    EXPECT_EQ(read_integers[0], kMax);
    EXPECT_EQ(read_integers[1], 0);
    EXPECT_EQ(read_integers[2], GLint(std::floor((4294967295.0 * 0.25 - 1) / 2 + 0.5)));
    EXPECT_GL(GL_NO_ERROR);
  };
  constexpr GLenum kTexture = GL_TEXTURE_2D, kBorder = GL_TEXTURE_BORDER_COLOR;
  check([&](const GLint* v) { op::tex_parameteriv(gl(), kTexture, kBorder, v); },
        [&](const GLfloat* v) { op::tex_parameterfv(gl(), kTexture, kBorder, v); },
        [&](GLfloat* v) { op::get_tex_parameterfv(gl(), kTexture, kBorder, v); },
        [&](GLint* v) { op::get_tex_parameteriv(gl(), kTexture, kBorder, v); });
  constexpr GLenum kEnv = GL_TEXTURE_ENV, kColor = GL_TEXTURE_ENV_COLOR;
  check([&](const GLint* v) { op::tex_enviv(gl(), kEnv, kColor, v); },
        [&](const GLfloat* v) { op::tex_envfv(gl(), kEnv, kColor, v); },
        [&](GLfloat* v) { op::get_tex_envfv(gl(), kEnv, kColor, v); },
        [&](GLint* v) { op::get_tex_enviv(gl(), kEnv, kColor, v); });
  EXPECT_EQ(texture_env_color(gl()), (raster::Color{1, 0, 0.25f, 0}));
}

TEST_F(TextureParamsTest, PriorityIsClamped) {
  const auto priority = [&](GLfloat value) {
    op::tex_parameterfv(gl(), GL_TEXTURE_2D, GL_TEXTURE_PRIORITY, &value);
    GLfloat read = -1;
    op::get_tex_parameterfv(gl(), GL_TEXTURE_2D, GL_TEXTURE_PRIORITY, &read);
    return read;
  };
  EXPECT_EQ(priority(0.375f), 0.375f);
  EXPECT_EQ(priority(7.0f), 1.0f);
  EXPECT_EQ(priority(-7.0f), 0.0f);
}

// Integers stand for [-1, 1] here too (table 2.9).
TEST_F(TextureParamsTest, PriorityAsInteger) {
  const auto priority = [&](GLint value) {
    set(GL_TEXTURE_PRIORITY, value);
    GLfloat read = -1;
    op::get_tex_parameterfv(gl(), GL_TEXTURE_2D, GL_TEXTURE_PRIORITY, &read);
    return read;
  };
  EXPECT_EQ(priority(std::numeric_limits<GLint>::max()), 1.0f);
  EXPECT_EQ(priority(std::numeric_limits<GLint>::min()), 0.0f);
  EXPECT_EQ(priority(1 << 30), 0.5f);
  EXPECT_EQ(get(GL_TEXTURE_PRIORITY), GLint((4294967295.0 * 0.5 - 1) / 2));
  EXPECT_GL(GL_NO_ERROR);
}

TEST_F(TextureParamsTest, Environment) {
  GLint mode = 0;
  op::get_tex_enviv(gl(), GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, &mode);
  EXPECT_EQ(mode, GL_MODULATE);
  const std::pair<GLint, raster::EnvMode> kModes[] = {{GL_DECAL, raster::EnvMode::decal},
                                                      {GL_BLEND, raster::EnvMode::blend},
                                                      {GL_REPLACE, raster::EnvMode::replace},
                                                      {GL_MODULATE, raster::EnvMode::modulate}};
  for (const auto& [value, expected] : kModes) {
    const GLfloat as_float = GLfloat(value);
    op::tex_envfv(gl(), GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, &as_float);
    EXPECT_GL(GL_NO_ERROR);
    EXPECT_EQ(texture_env_mode(gl()), expected);
  }
  const GLint add = GL_ADD, decal = GL_DECAL;  // GL_ADD is 1.3's
  op::tex_enviv(gl(), GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, &add);
  EXPECT_GL(GL_INVALID_ENUM);
  op::tex_enviv(gl(), GL_TEXTURE_2D, GL_TEXTURE_ENV_MODE, &decal);
  EXPECT_GL(GL_INVALID_ENUM);
  op::tex_enviv(gl(), GL_TEXTURE_ENV, GL_TEXTURE_WRAP_S, &decal);
  EXPECT_GL(GL_INVALID_ENUM);
  op::get_tex_enviv(gl(), GL_TEXTURE_2D, GL_TEXTURE_ENV_MODE, &mode);
  EXPECT_GL(GL_INVALID_ENUM);
  op::get_tex_enviv(gl(), GL_TEXTURE_ENV, GL_TEXTURE_WRAP_S, &mode);
  EXPECT_GL(GL_INVALID_ENUM);
  EXPECT_EQ(texture_env_mode(gl()), raster::EnvMode::modulate);
}

TEST_F(TextureParamsTest, TheSamplerSaysWhatWasAskedFor) {
  gl().texture.enabled_2d = true;
  image(0, 1, 1);
  using raster::Filter;
  using raster::MipMode;
  const std::tuple<GLint, Filter, MipMode> kFilters[] = {
      {GL_NEAREST, Filter::nearest, MipMode::none},
      {GL_LINEAR, Filter::linear, MipMode::none},
      {GL_NEAREST_MIPMAP_NEAREST, Filter::nearest, MipMode::nearest},
      {GL_LINEAR_MIPMAP_NEAREST, Filter::linear, MipMode::nearest},
      {GL_NEAREST_MIPMAP_LINEAR, Filter::nearest, MipMode::linear},
      {GL_LINEAR_MIPMAP_LINEAR, Filter::linear, MipMode::linear}};
  set(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  set(GL_TEXTURE_WRAP_S, GL_CLAMP);
  set(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  const GLfloat border[4] = {0.125f, 0.25f, 0.5f, 1};
  op::tex_parameterfv(gl(), GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border);
  for (const auto& [value, filter, mip] : kFilters) {
    set(GL_TEXTURE_MIN_FILTER, value);
    const auto view = current_texture_view(gl());
    ASSERT_NE(view, nullptr);
    EXPECT_EQ(view->sampler, (raster::Sampler{.mag = Filter::nearest,
                                              .min = filter,
                                              .mip = mip,
                                              .wrap_s = raster::Wrap::clamp,
                                              .wrap_t = raster::Wrap::clamp_to_edge,
                                              .border_color = {0.125f, 0.25f, 0.5f, 1}}));
  }
}

TEST_F(TextureParamsTest, WithoutMipmapsLevelZeroIsEnough) {
  gl().texture.enabled_2d = true;
  EXPECT_EQ(view_levels(), 0);
  image(0, 16, 4);
  EXPECT_EQ(view_levels(), 0);  // the initial filter wants mipmaps
  set(GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  EXPECT_EQ(view_levels(), 1);
  image(1, 2, 64);  // nonsense above does not matter
  EXPECT_EQ(view_levels(), 1);
}

TEST_F(TextureParamsTest, MipmapsMustReachOneByOneAndAgree) {
  gl().texture.enabled_2d = true;
  image(0, 16, 4);
  image(1, 8, 2);
  image(2, 4, 1);
  image(3, 2, 1);
  EXPECT_EQ(view_levels(), 0);
  image(4, 1, 1);
  EXPECT_EQ(view_levels(), 5);
  image(5, 64, 64);  // beyond the last: not looked at
  EXPECT_EQ(view_levels(), 5);
  image(2, 2, 1);
  EXPECT_EQ(view_levels(), 0) << "size";
  image(2, 4, 1, GL_RGB);
  EXPECT_EQ(view_levels(), 0) << "format";
  image(2, 4, 1, GL_RGBA8);
  EXPECT_EQ(view_levels(), 0) << "sized format";
  image(2, 4, 1, 4);
  EXPECT_EQ(view_levels(), 5) << "4 is another name of GL_RGBA";
  image(2, 6, 3, GL_RGBA, 1);
  EXPECT_EQ(view_levels(), 0) << "border";
  image(2, 4, 1);
  EXPECT_EQ(view_levels(), 5);
  image(0, 0, 0);
  EXPECT_EQ(view_levels(), 0) << "no level 0";
}

TEST_F(TextureParamsTest, MipmapsWithBorders) {
  gl().texture.enabled_2d = true;
  image(0, 6, 4, GL_LUMINANCE, 1);
  image(1, 4, 3, GL_LUMINANCE, 1);
  EXPECT_EQ(view_levels(), 0);
  image(2, 3, 3, GL_LUMINANCE, 1);
  EXPECT_EQ(view_levels(), 3);
}

}  // namespace
}  // namespace halfspace::state
