// One-dimensional textures: glTexImage1D, glTexSubImage1D and what is asked about them
// (spec 3.8.1, 3.8.2, 6.1.3).
#include <functional>
#include <vector>

#include "raster/texture/level.h"
#include "tests/unit/pixel_fixture.h"

namespace halfspace::state {
namespace {

using Texels = std::vector<uint8_t>;

Texels counting_texels(size_t count) {
  Texels out(count * 4);
  for (size_t i = 0; i < out.size(); ++i) out[i] = uint8_t(i * 53 + 9);
  return out;
}

class Texture1dTest : public PixelTest {
 protected:
  void image(GLint level, GLsizei width, GLint border, const void* pixels, GLint internal_format = GL_RGBA,
             GLenum target = GL_TEXTURE_1D) {
    op::tex_image_1d(gl(), target, level, internal_format, width, border, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  }
  void set(GLenum pname, GLint value) { op::tex_parameteriv(gl(), GL_TEXTURE_1D, pname, &value); }
  GLint query(GLenum pname, GLint level = 0, GLenum target = GL_TEXTURE_1D) {
    GLint value = -77;
    op::get_tex_level_parameteriv(gl(), target, level, pname, &value);
    return value;
  }
  Texels read(size_t width) {
    Texels out(width * 4, 0xCD);
    op::get_tex_image(gl(), GL_TEXTURE_1D, 0, GL_RGBA, GL_UNSIGNED_BYTE, out.data());
    return out;
  }
};

TEST_F(Texture1dTest, KeepsTexelsAndSaysSo) {
  for (GLint border : {0, 1}) {
    const auto width = GLsizei(16 + 2 * border);
    const Texels source = counting_texels(size_t(width));
    image(0, width, border, source.data());
    EXPECT_GL(GL_NO_ERROR);
    EXPECT_EQ(query(GL_TEXTURE_WIDTH), width);
    EXPECT_EQ(query(GL_TEXTURE_HEIGHT), 1);
    EXPECT_EQ(query(GL_TEXTURE_BORDER), border);
    EXPECT_EQ(query(GL_TEXTURE_INTERNAL_FORMAT), GL_RGBA);
    EXPECT_EQ(query(GL_TEXTURE_WIDTH, 0, GL_TEXTURE_2D), 0);  // another texture
    Texels out(size_t(width) * 4 + 8, 0xCD), expected = source;
    expected.resize(out.size(), 0xCD);
    op::get_tex_image(gl(), GL_TEXTURE_1D, 0, GL_RGBA, GL_UNSIGNED_BYTE, out.data());
    EXPECT_EQ(out, expected);
  }
}

TEST_F(Texture1dTest, SubImagesReachTheBorder) {
  const Texels source = counting_texels(10), patch(3 * 4, 0x5A);
  image(0, 10, 1, source.data());
  Texels expected = source;
  const auto put = [&](GLint x) {
    op::tex_sub_image_1d(gl(), GL_TEXTURE_1D, 0, x, 3, GL_RGBA, GL_UNSIGNED_BYTE, patch.data());
    std::fill_n(&expected[size_t(x + 1) * 4], 12, uint8_t{0x5A});
    EXPECT_GL(GL_NO_ERROR);
    EXPECT_EQ(read(10), expected);
  };
  put(-1);
  put(3);
  put(6);
}

// Wherever t points, the sampler finds the row itself, and its border left and right.
TEST_F(Texture1dTest, EveryRowIsTheSame) {
  for (GLint border : {0, 1}) {
    const Texels source = counting_texels(size_t(4 + 2 * border));
    image(0, 4 + 2 * border, border, source.data());
    set(GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    set(GL_TEXTURE_WRAP_S, GL_CLAMP);
    set(GL_TEXTURE_WRAP_T, GL_CLAMP);
    op::enable(gl(), GL_TEXTURE_1D);
    const auto view = current_texture_view(gl());
    ASSERT_NE(view, nullptr);
    EXPECT_TRUE(view->sampler.one_dimensional);
    EXPECT_EQ(view->sampler.wrap_t, raster::Wrap::repeat);
    EXPECT_EQ(view->sampler.wrap_s, raster::Wrap::clamp);
    const raster::TextureLevel& level = *view->levels[0];
    for (int i = -1; i <= 4; ++i) {
      EXPECT_EQ(level.texel(i, -1), level.texel(i, 0)) << i;
      EXPECT_EQ(level.texel(i, 1), level.texel(i, 0)) << i;
      if (border == 1) {
        EXPECT_EQ(level.texel(i, 0) & 0xff, source[size_t(i + 1) * 4]) << i;
      }
    }
  }
}

TEST_F(Texture1dTest, CompleteDownToOneTexel) {
  const auto levels = [&] {
    const auto view = current_texture_view(gl());
    return view == nullptr ? 0 : view->level_count;
  };
  op::enable(gl(), GL_TEXTURE_1D);
  for (GLint border : {0, 1}) {
    for (GLint level = 0; level < 4; ++level) {
      EXPECT_EQ(levels(), 0) << level;
      image(level, (8 >> level) + 2 * border, border, nullptr);
    }
    EXPECT_EQ(levels(), 4);
    image(1, 8 + 2 * border, border, nullptr);
    EXPECT_EQ(levels(), 0);
    for (GLint level = 0; level < 4; ++level) image(level, 0, 0, nullptr);
  }
  image(0, 2, 0, nullptr);
  image(1, 3, 1, nullptr);
  EXPECT_EQ(levels(), 0) << "borders differ";
}

TEST_F(Texture1dTest, ProxiesAnswer) {
  image(0, 16, 0, nullptr, GL_RGB5, GL_PROXY_TEXTURE_1D);
  EXPECT_EQ(query(GL_TEXTURE_WIDTH, 0, GL_PROXY_TEXTURE_1D), 16);
  EXPECT_EQ(query(GL_TEXTURE_HEIGHT, 0, GL_PROXY_TEXTURE_1D), 1);
  EXPECT_EQ(query(GL_TEXTURE_INTERNAL_FORMAT, 0, GL_PROXY_TEXTURE_1D), GL_RGB5);
  EXPECT_EQ(query(GL_TEXTURE_WIDTH, 0, GL_PROXY_TEXTURE_2D), 0);
  EXPECT_EQ(query(GL_TEXTURE_WIDTH), 0);
  image(0, 2 * raster::kMaxTextureSize, 0, nullptr, GL_RGB5, GL_PROXY_TEXTURE_1D);
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_EQ(query(GL_TEXTURE_WIDTH, 0, GL_PROXY_TEXTURE_1D), 0);
  EXPECT_EQ(query(GL_TEXTURE_INTERNAL_FORMAT, 0, GL_PROXY_TEXTURE_1D), 0);
  image(0, -1, 0, nullptr, GL_RGB5, GL_PROXY_TEXTURE_1D);
  EXPECT_GL(GL_INVALID_VALUE);
}

TEST_F(Texture1dTest, RefusedCallsChangeNothing) {
  const Texels source = counting_texels(8), patch(64, 0x11);
  image(0, 8, 0, source.data());
  constexpr GLenum k1D = GL_TEXTURE_1D, kByte = GL_UNSIGNED_BYTE;
  const auto define = [&](GLenum target, GLint level, GLint internal, GLsizei width, GLint border,
                          GLenum format, GLenum type) {
    return [=, &patch](Context& c) {
      op::tex_image_1d(c, target, level, internal, width, border, format, type, patch.data());
    };
  };
  const auto update = [&](GLenum target, GLint level, GLint x, GLsizei width, GLenum format, GLenum type) {
    return [=, &patch](Context& c) {
      op::tex_sub_image_1d(c, target, level, x, width, format, type, patch.data());
    };
  };
  const std::pair<GLenum, std::function<void(Context&)>> calls[] = {
      {GL_INVALID_ENUM, define(GL_TEXTURE_2D, 0, GL_RGBA, 4, 0, GL_RGBA, kByte)},
      {GL_INVALID_ENUM, define(GL_PROXY_TEXTURE_2D, 0, GL_RGBA, 4, 0, GL_RGBA, kByte)},
      {GL_INVALID_VALUE, define(k1D, -1, GL_RGBA, 4, 0, GL_RGBA, kByte)},
      {GL_INVALID_VALUE, define(k1D, raster::kMaxTextureLevels, GL_RGBA, 1, 0, GL_RGBA, kByte)},
      {GL_INVALID_VALUE, define(k1D, 0, 5, 4, 0, GL_RGBA, kByte)},
      {GL_INVALID_VALUE, define(k1D, 0, GL_RGBA, -4, 0, GL_RGBA, kByte)},
      {GL_INVALID_VALUE, define(k1D, 0, GL_RGBA, 5, 0, GL_RGBA, kByte)},
      {GL_INVALID_VALUE, define(k1D, 0, GL_RGBA, 5, 1, GL_RGBA, kByte)},
      {GL_INVALID_VALUE, define(k1D, 0, GL_RGBA, 8, 2, GL_RGBA, kByte)},
      {GL_INVALID_VALUE, define(k1D, 2, GL_RGBA, raster::kMaxTextureSize / 2, 0, GL_RGBA, kByte)},
      {GL_INVALID_ENUM, define(k1D, 0, GL_RGBA, 4, 0, GL_DEPTH_COMPONENT, kByte)},
      {GL_INVALID_ENUM, define(k1D, 0, GL_RGBA, 4, 0, GL_RGBA, GL_BITMAP)},
      {GL_INVALID_OPERATION, define(k1D, 0, GL_RGBA, 4, 0, GL_RGB, GL_UNSIGNED_SHORT_4_4_4_4)},
      {GL_INVALID_ENUM, update(GL_TEXTURE_2D, 0, 0, 1, GL_RGBA, kByte)},
      {GL_INVALID_ENUM, update(GL_PROXY_TEXTURE_1D, 0, 0, 1, GL_RGBA, kByte)},
      {GL_INVALID_VALUE, update(k1D, -1, 0, 1, GL_RGBA, kByte)},
      {GL_INVALID_VALUE, update(k1D, 0, -1, 2, GL_RGBA, kByte)},
      {GL_INVALID_VALUE, update(k1D, 0, 7, 2, GL_RGBA, kByte)},
      {GL_INVALID_VALUE, update(k1D, 0, 0, -1, GL_RGBA, kByte)},
      {GL_INVALID_OPERATION, update(k1D, 1, 0, 1, GL_RGBA, kByte)},
      {GL_INVALID_ENUM, update(k1D, 0, 0, 1, GL_STENCIL_INDEX, kByte)},
  };
  for (const auto& [code, call] : calls) {
    call(gl());
    EXPECT_GL(code) << "call " << &code - &calls[0].first;
    EXPECT_EQ(read(8), source);
    EXPECT_EQ(query(GL_TEXTURE_WIDTH), 8);
  }
}

}  // namespace
}  // namespace halfspace::state
