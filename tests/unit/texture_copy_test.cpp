// glCopyTexImage, glCopyTexSubImage (spec 3.8.2): which pixels land where, what is refused.
#include <array>
#include <functional>
#include <thread>
#include <vector>

#include "tests/unit/pixel_fixture.h"

namespace halfspace::state {
namespace {

using Texels = std::vector<uint8_t>;

// What pixel (x, y) holds: no two alike, no two components alike.
std::array<uint8_t, 4> pixel_at(int x, int y) {
  return {uint8_t(7 * x), uint8_t(11 * y + 3), uint8_t(x + 5 * y), uint8_t(200 - 3 * x - y)};
}

class TextureCopyTest : public PixelTest {
 protected:
  TextureCopyTest() { paint(); }

  void paint() {
    op::enable(gl(), GL_SCISSOR_TEST);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const auto c = pixel_at(x, y);
        op::scissor(gl(), x, y, 1, 1);
        op::clear_color(gl(), c[0] / 255.0f, c[1] / 255.0f, c[2] / 255.0f, c[3] / 255.0f);
        op::clear(gl(), GL_COLOR_BUFFER_BIT);
      }
    }
    op::disable(gl(), GL_SCISSOR_TEST);
  }
  GLint query(GLenum pname, GLenum target = GL_TEXTURE_2D) {
    GLint value = -77;
    op::get_tex_level_parameteriv(gl(), target, 0, pname, &value);
    return value;
  }
  Texels read(size_t count, GLenum target = GL_TEXTURE_2D) {
    Texels out(count * 4, 0xCD);
    op::get_tex_image(gl(), target, 0, GL_RGBA, GL_UNSIGNED_BYTE, out.data());
    return out;
  }
  void image(GLsizei width, GLsizei height, GLint border, uint8_t fill) {
    const Texels texels(size_t(width * height) * 4, fill);
    op::tex_image_2d(gl(), GL_TEXTURE_2D, 0, GL_RGBA, width, height, border, GL_RGBA, GL_UNSIGNED_BYTE,
                     texels.data());
  }
};

// A width x height rectangle of the window at (x, y); zeros where there is no window.
Texels window_texels(int x, int y, int width, int height, int window_width, int window_height) {
  Texels out;
  for (int j = y; j < y + height; ++j) {
    for (int i = x; i < x + width; ++i) {
      const bool exists = i >= 0 && i < window_width && j >= 0 && j < window_height;
      const auto c = exists ? pixel_at(i, j) : std::array<uint8_t, 4>{};
      out.insert(out.end(), c.begin(), c.end());
    }
  }
  return out;
}

TEST_F(TextureCopyTest, TakesTheRectangle) {
  op::copy_tex_image_2d(gl(), GL_TEXTURE_2D, 0, GL_RGBA8, 3, 5, 16, 8, 0);
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_EQ(query(GL_TEXTURE_WIDTH), 16);
  EXPECT_EQ(query(GL_TEXTURE_HEIGHT), 8);
  EXPECT_EQ(query(GL_TEXTURE_INTERNAL_FORMAT), GL_RGBA8);
  EXPECT_EQ(read(16 * 8), window_texels(3, 5, 16, 8, kWidth, kHeight));
}

TEST_F(TextureCopyTest, BordersComeAlong) {
  op::copy_tex_image_2d(gl(), GL_TEXTURE_2D, 0, GL_RGBA, 2, 1, 10, 6, 1);
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_EQ(query(GL_TEXTURE_BORDER), 1);
  EXPECT_EQ(read(10 * 6), window_texels(2, 1, 10, 6, kWidth, kHeight));
  op::copy_tex_image_1d(gl(), GL_TEXTURE_1D, 0, GL_RGBA, 20, 9, 10, 1);
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_EQ(query(GL_TEXTURE_WIDTH, GL_TEXTURE_1D), 10);
  EXPECT_EQ(query(GL_TEXTURE_HEIGHT, GL_TEXTURE_1D), 1);
  EXPECT_EQ(read(10, GL_TEXTURE_1D), window_texels(20, 9, 10, 1, kWidth, kHeight));
}

TEST_F(TextureCopyTest, BaseFormatsKeepTheirComponents) {
  const auto c = pixel_at(6, 4);
  const std::pair<GLenum, std::array<uint8_t, 4>> kExpected[] = {{GL_ALPHA16, {0, 0, 0, c[3]}},
                                                                 {GL_LUMINANCE4, {c[0], 0, 0, 255}},
                                                                 {GL_LUMINANCE_ALPHA, {c[0], 0, 0, c[3]}},
                                                                 {GL_INTENSITY, {c[0], 0, 0, 255}},
                                                                 {GL_R3_G3_B2, {c[0], c[1], c[2], 255}},
                                                                 {GL_RGBA12, c}};
  for (const auto& [format, expected] : kExpected) {
    op::copy_tex_image_1d(gl(), GL_TEXTURE_1D, 0, format, 6, 4, 1, 0);
    EXPECT_GL(GL_NO_ERROR);
    EXPECT_EQ(read(1, GL_TEXTURE_1D), Texels(expected.begin(), expected.end())) << std::hex << format;
  }
}

// Outside the window texels are undefined, but never someone else's memory.
TEST_F(TextureCopyTest, OutsideTheWindowIsZero) {
  for (const auto& [x, y] :
       {std::pair{-5, -3}, {30, 15}, {-40, 0}, {0, 900}, {-2, 3}, {0x7FFFFFF0, -0x7FFFFFF0}}) {
    op::copy_tex_image_2d(gl(), GL_TEXTURE_2D, 0, GL_RGBA, x, y, 16, 16, 0);
    EXPECT_GL(GL_NO_ERROR);
    if (x < 1000) {
      EXPECT_EQ(read(256), window_texels(x, y, 16, 16, kWidth, kHeight)) << x << ", " << y;
    }
  }
  op::copy_tex_image_2d(gl(), GL_TEXTURE_2D, 0, GL_RGBA, -10, -10, 64, 64, 0);  // all of it
  EXPECT_EQ(read(64 * 64), window_texels(-10, -10, 64, 64, kWidth, kHeight));
}

TEST_F(TextureCopyTest, SubImagesChangeTheirTexelsOnly) {
  image(10, 10, 1, 0x31);
  op::copy_tex_sub_image_2d(gl(), GL_TEXTURE_2D, 0, -1, 4, 7, 2, 5, 3);
  EXPECT_GL(GL_NO_ERROR);
  Texels expected(400, 0x31);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) {
      const auto c = pixel_at(7 + x, 2 + y);
      std::copy(c.begin(), c.end(), &expected[size_t((y + 5) * 10 + x) * 4]);
    }
  }
  EXPECT_EQ(read(100), expected);
  // Pixels that do not exist leave their texels alone.
  image(8, 8, 0, 0x42);
  op::copy_tex_sub_image_2d(gl(), GL_TEXTURE_2D, 0, 0, 0, kWidth - 3, -2, 8, 8);
  EXPECT_GL(GL_NO_ERROR);
  expected.assign(256, 0x42);
  for (int y = 2; y < 8; ++y) {
    for (int x = 0; x < 3; ++x) {
      const auto c = pixel_at(kWidth - 3 + x, y - 2);
      std::copy(c.begin(), c.end(), &expected[size_t(y * 8 + x) * 4]);
    }
  }
  EXPECT_EQ(read(64), expected);
  op::copy_tex_sub_image_2d(gl(), GL_TEXTURE_2D, 0, 0, 0, -100, 0, 8, 8);
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_EQ(read(64), expected);
}

TEST_F(TextureCopyTest, OneDimensionalSubImages) {
  const Texels source(6 * 4, 0x55);
  op::tex_image_1d(gl(), GL_TEXTURE_1D, 0, GL_RGBA, 6, 1, GL_RGBA, GL_UNSIGNED_BYTE, source.data());
  op::copy_tex_sub_image_1d(gl(), GL_TEXTURE_1D, 0, -1, 11, 13, 4);
  EXPECT_GL(GL_NO_ERROR);
  Texels expected = window_texels(11, 13, 4, 1, kWidth, kHeight);
  expected.resize(6 * 4, 0x55);
  EXPECT_EQ(read(6, GL_TEXTURE_1D), expected);
}

TEST_F(TextureCopyTest, WithoutAlphaPlanesAlphaIsOne) {
  VisualConfig opaque;
  opaque.alpha_bits = 0;
  open(opaque);
  paint();
  op::copy_tex_image_2d(gl(), GL_TEXTURE_2D, 0, GL_RGBA, 4, 4, 1, 1, 0);
  EXPECT_EQ(read(1)[3], 255);
  EXPECT_EQ(read(1)[0], pixel_at(4, 4)[0]);
}

// Scale, bias and maps act on what is copied, as on what glCopyPixels copies.
TEST_F(TextureCopyTest, GoesThroughPixelTransfer) {
  image(2, 1, 0, 0x31);
  op::pixel_transfer(gl(), GL_RED_SCALE, 0.5);
  op::pixel_transfer(gl(), GL_GREEN_SCALE, 2);
  op::pixel_transfer(gl(), GL_BLUE_BIAS, 1);
  op::pixel_transfer(gl(), GL_ALPHA_SCALE, 0);
  op::pixel_transfer(gl(), GL_ALPHA_BIAS, 0.2);
  const auto c = pixel_at(9, 8);
  const Texels expected = {uint8_t((c[0] + 1) / 2), uint8_t(std::min(255, 2 * c[1])), 255, 51};
  op::copy_tex_sub_image_2d(gl(), GL_TEXTURE_2D, 0, 1, 0, 9, 8, 1, 1);
  const Texels both = read(2);  // transfer is not for what is read back
  EXPECT_EQ(Texels(both.begin(), both.begin() + 4), Texels(4, 0x31));
  EXPECT_EQ(Texels(both.begin() + 4, both.end()), expected);
  op::copy_tex_image_2d(gl(), GL_TEXTURE_2D, 0, GL_RGBA, 9, 8, 1, 1, 0);
  EXPECT_EQ(read(1), expected);
}

TEST_F(TextureCopyTest, ReadsTheReadBuffer) {
  VisualConfig two;
  two.double_buffered = true;
  open(two);
  op::draw_buffer(gl(), GL_FRONT);
  op::clear_color(gl(), 1, 0, 0, 1);
  op::clear(gl(), GL_COLOR_BUFFER_BIT);
  op::draw_buffer(gl(), GL_BACK);
  op::clear_color(gl(), 0, 0, 1, 1);
  op::clear(gl(), GL_COLOR_BUFFER_BIT);
  op::copy_tex_image_2d(gl(), GL_TEXTURE_2D, 0, GL_RGB, 0, 0, 1, 1, 0);
  EXPECT_EQ(read(1), (Texels{0, 0, 255, 255}));
  op::read_buffer(gl(), GL_FRONT);
  op::copy_tex_image_2d(gl(), GL_TEXTURE_2D, 0, GL_RGB, 0, 0, 1, 1, 0);
  EXPECT_EQ(read(1), (Texels{255, 0, 0, 255}));
}

// What was drawn before counts, what the texture looked like to earlier draws stays.
TEST_F(TextureCopyTest, TheViewOfAnEarlierDrawStays) {
  image(1, 1, 0, 0x10);
  const GLint nearest = GL_NEAREST;
  op::tex_parameteriv(gl(), GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, &nearest);
  op::enable(gl(), GL_TEXTURE_2D);
  const auto before = current_texture_view(gl());
  op::copy_tex_image_2d(gl(), GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 1, 1, 0);
  ASSERT_NE(before, nullptr);
  EXPECT_NE(current_texture_view(gl())->levels[0], before->levels[0]);
}

// Another context makes the image smaller while this one copies to where it was.
TEST_F(TextureCopyTest, SharedImagesMayChangeMeanwhile) {
  Context other(gl().visual, &gl());
  op::bind_texture(gl(), GL_TEXTURE_2D, 4);
  op::bind_texture(other, GL_TEXTURE_2D, 4);
  const auto define = [](Context& context, GLsizei side) {
    op::tex_image_2d(context, GL_TEXTURE_2D, 0, GL_RGBA, side, side, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  };
  define(other, 64);
  std::thread thread([&] {
    for (int i = 0; i < 20000; ++i) define(other, i % 2 == 0 ? 1 : 64);
  });
  for (int i = 0; i < 10000; ++i) {
    op::copy_tex_sub_image_2d(gl(), GL_TEXTURE_2D, 0, 30, 44, 0, 0, 34, 20);
    const GLenum code = error();
    EXPECT_TRUE(code == GL_NO_ERROR || code == GL_INVALID_VALUE) << code;
  }
  thread.join();
  EXPECT_EQ(query(GL_TEXTURE_WIDTH), 64);
}

TEST_F(TextureCopyTest, RefusedCallsChangeNothing) {
  image(4, 4, 0, 0x77);
  const Texels source(4 * 4, 0x78);
  op::tex_image_1d(gl(), GL_TEXTURE_1D, 0, GL_RGBA, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, source.data());
  constexpr GLenum k1D = GL_TEXTURE_1D, k2D = GL_TEXTURE_2D;
  const auto copy_1d = [](GLenum target, GLint level, GLenum format, GLsizei width, GLint border) {
    return [=](Context& c) { op::copy_tex_image_1d(c, target, level, format, 0, 0, width, border); };
  };
  const auto copy_2d = [](GLenum target, GLint level, GLenum format, GLsizei width, GLsizei height,
                          GLint border) {
    return [=](Context& c) { op::copy_tex_image_2d(c, target, level, format, 0, 0, width, height, border); };
  };
  const auto sub_1d = [](GLenum target, GLint level, GLint x, GLsizei width) {
    return [=](Context& c) { op::copy_tex_sub_image_1d(c, target, level, x, 0, 0, width); };
  };
  const auto sub_2d = [](GLenum target, GLint level, GLint x, GLint y, GLsizei width, GLsizei height) {
    return [=](Context& c) { op::copy_tex_sub_image_2d(c, target, level, x, y, 0, 0, width, height); };
  };
  const std::pair<GLenum, std::function<void(Context&)>> calls[] = {
      {GL_INVALID_ENUM, copy_1d(k2D, 0, GL_RGBA, 2, 0)},
      {GL_INVALID_ENUM, copy_1d(GL_PROXY_TEXTURE_1D, 0, GL_RGBA, 2, 0)},
      {GL_INVALID_ENUM, copy_1d(k1D, 0, 4, 2, 0)},
      {GL_INVALID_ENUM, copy_1d(k1D, 0, GL_BGRA, 2, 0)},
      {GL_INVALID_VALUE, copy_1d(k1D, -1, GL_RGBA, 2, 0)},
      {GL_INVALID_VALUE, copy_1d(k1D, raster::kMaxTextureLevels, GL_RGBA, 1, 0)},
      {GL_INVALID_VALUE, copy_1d(k1D, 0, GL_RGBA, -1, 0)},
      {GL_INVALID_VALUE, copy_1d(k1D, 0, GL_RGBA, 3, 0)},
      {GL_INVALID_VALUE, copy_1d(k1D, 0, GL_RGBA, 5, 1)},
      {GL_INVALID_VALUE, copy_1d(k1D, 0, GL_RGBA, 2, 2)},
      {GL_INVALID_VALUE, copy_1d(k1D, 1, GL_RGBA, raster::kMaxTextureSize, 0)},
      {GL_INVALID_ENUM, copy_2d(k1D, 0, GL_RGBA, 2, 2, 0)},
      {GL_INVALID_ENUM, copy_2d(GL_PROXY_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0)},
      {GL_INVALID_ENUM, copy_2d(k2D, 0, 1, 2, 2, 0)},
      {GL_INVALID_VALUE, copy_2d(k2D, 0, GL_RGBA, 2, 3, 0)},
      {GL_INVALID_VALUE, copy_2d(k2D, 0, GL_RGBA, 2, -2, 0)},
      {GL_INVALID_ENUM, sub_1d(k2D, 0, 0, 1)},
      {GL_INVALID_VALUE, sub_1d(k1D, -1, 0, 1)},
      {GL_INVALID_VALUE, sub_1d(k1D, 0, -1, 2)},
      {GL_INVALID_VALUE, sub_1d(k1D, 0, 3, 2)},
      {GL_INVALID_VALUE, sub_1d(k1D, 0, 0, -1)},
      {GL_INVALID_OPERATION, sub_1d(k1D, 1, 0, 1)},
      {GL_INVALID_ENUM, sub_2d(k1D, 0, 0, 0, 1, 1)},
      {GL_INVALID_VALUE, sub_2d(k2D, 0, 0, 0, 1, 5)},
      {GL_INVALID_VALUE, sub_2d(k2D, 0, 0, -1, 1, 1)},
      {GL_INVALID_VALUE, sub_2d(k2D, 0, 0, 0, -1, 1)},
      {GL_INVALID_VALUE, sub_2d(k2D, 99, 0, 0, 1, 1)},
      {GL_INVALID_OPERATION, sub_2d(k2D, 2, 0, 0, 1, 1)},
  };
  for (const auto& [code, call] : calls) {
    call(gl());
    EXPECT_GL(code) << "call " << &code - &calls[0].first;
    EXPECT_EQ(read(16), Texels(64, 0x77));
    EXPECT_EQ(read(4, k1D), Texels(16, 0x78));
  }
}

}  // namespace
}  // namespace halfspace::state
