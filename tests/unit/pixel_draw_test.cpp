// glRasterPos, glDrawPixels, glBitmap and glCopyPixels (spec 2.13, 3.6.4, 3.7, 4.3.3).
#include <cmath>
#include <cstring>
#include <vector>

#include "tests/unit/pixel_fixture.h"

namespace halfspace::state {
namespace {

using Pixel = std::array<uint8_t, 4>;

class PixelDrawTest : public PixelTest {
 protected:
  // One unit a pixel, from the lower left corner.
  void look_at_pixels() {
    op::matrix_mode(gl(), GL_PROJECTION);
    op::load_identity(gl());
    op::ortho(gl(), 0, kWidth, 0, kHeight, -1, 1);
    op::matrix_mode(gl(), GL_MODELVIEW);
    op::pixel_storei(gl(), GL_UNPACK_ALIGNMENT, 1);
    op::pixel_storei(gl(), GL_PACK_ALIGNMENT, 1);
  }
  void clear(float r, float g, float b, float a) {
    op::clear_color(gl(), r, g, b, a);
    op::clear(gl(), GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  }
  std::vector<Pixel> read() {
    std::vector<Pixel> out(kWidth * kHeight);
    op::read_pixels(gl(), 0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, out.data());
    EXPECT_GL(GL_NO_ERROR);
    return out;
  }
  std::vector<uint32_t> read_depth() {
    std::vector<GLuint> out(kWidth * kHeight);
    op::read_pixels(gl(), 0, 0, kWidth, kHeight, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, out.data());
    for (GLuint& d : out) d = GLuint(std::llround(double(d) / 4294967295.0 * 16777215.0));
    return out;
  }
  template <class T, size_t kCount>
  std::array<T, kCount> get(GLenum name) {
    std::array<T, kCount> v{};
    if constexpr (std::is_same_v<T, GLfloat>)
      op::get_floatv(gl(), name, v.data());
    else
      op::get_integerv(gl(), name, v.data());
    EXPECT_GL(GL_NO_ERROR);
    return v;
  }
  bool valid() { return get<GLint, 1>(GL_CURRENT_RASTER_POSITION_VALID)[0] != 0; }
  static std::vector<Pixel> pattern(int width, int height) {
    std::vector<Pixel> image(size_t(width * height));
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        image[size_t(y * width + x)] = {uint8_t(x * 17 + 3), uint8_t(y * 23 + 1), uint8_t(x * y * 5),
                                        uint8_t(255 - x)};
    return image;
  }
};

TEST_F(PixelDrawTest, TheRasterPositionGoesThroughTheVertexStage) {
  EXPECT_TRUE(valid());
  op::viewport(gl(), 3, 5, 20, 10);
  op::depth_range(gl(), 0.25, 0.75);
  op::matrix_mode(gl(), GL_MODELVIEW);
  op::translate(gl(), 0, 0, -0.5);
  op::color(gl(), 0.25f, 2, -1, 0.5f);
  op::tex_coord(gl(), 1, 2, 3, 4);
  op::index(gl(), 7);
  op::matrix_mode(gl(), GL_TEXTURE);
  op::scale(gl(), 2, 3, 4);
  op::raster_pos(gl(), 0.5f, -1.0f, 1.0f, 2.0f);
  EXPECT_TRUE(valid());
  // Clip (0.5, -1, 1 - 0.5 * 2, 2).
  EXPECT_EQ((get<GLfloat, 4>(GL_CURRENT_RASTER_POSITION)),
            (std::array<GLfloat, 4>{3 + 1.25f * 10, 5 + 0.5f * 5, 0.5f, 2}));
  EXPECT_EQ((get<GLfloat, 4>(GL_CURRENT_RASTER_COLOR)), (std::array<GLfloat, 4>{0.25f, 1, 0, 0.5f}));
  EXPECT_EQ((get<GLfloat, 4>(GL_CURRENT_RASTER_TEXTURE_COORDS)), (std::array<GLfloat, 4>{2, 6, 12, 4}));
  EXPECT_EQ((get<GLfloat, 1>(GL_CURRENT_RASTER_DISTANCE))[0], 0.0f);
  EXPECT_EQ((get<GLfloat, 1>(GL_CURRENT_RASTER_INDEX))[0], 7.0f);
  op::raster_pos(gl(), 0, 0, -0.25f, 1);
  EXPECT_EQ((get<GLfloat, 1>(GL_CURRENT_RASTER_DISTANCE))[0], 0.75f);
  // The edges of the clip volume belong to it.
  op::raster_pos(gl(), 1, -1, 1.5f, 1);
  EXPECT_TRUE(valid());
  for (const auto& p :
       {std::array<float, 3>{1.001f, 0, 0}, {-1.001f, 0, 0}, {0, 1.001f, 0}, {0, 0, 1.501f}, {0, 0, -0.6f}}) {
    op::raster_pos(gl(), p[0], p[1], p[2], 1);
    EXPECT_FALSE(valid());
  }
  op::raster_pos(gl(), 0, 0, 0, -1);
  EXPECT_FALSE(valid());
  op::raster_pos(gl(), NAN, 0, 0, 1);
  EXPECT_FALSE(valid());
  op::raster_pos(gl(), 0, 0, 0, 1);
  EXPECT_TRUE(valid());
}

TEST_F(PixelDrawTest, WindowCoordinatesAreTakenAsTheyAre) {
  op::depth_range(gl(), 0.5, 1);
  op::color(gl(), 0.5f, 2, -1, 1);
  op::raster_pos(gl(), 9, 9, 9, 1);
  EXPECT_FALSE(valid());
  op::window_pos(gl(), -3.5f, 100, 0.25f);
  EXPECT_TRUE(valid());
  EXPECT_EQ((get<GLfloat, 4>(GL_CURRENT_RASTER_POSITION)), (std::array<GLfloat, 4>{-3.5f, 100, 0.625f, 1}));
  EXPECT_EQ((get<GLfloat, 4>(GL_CURRENT_RASTER_COLOR)), (std::array<GLfloat, 4>{0.5f, 1, 0, 1}));
  op::window_pos(gl(), 0, 0, 7);
  EXPECT_EQ((get<GLfloat, 4>(GL_CURRENT_RASTER_POSITION))[2], 1.0f);
}

TEST_F(PixelDrawTest, PixelsLandWhereTheyBelong) {
  look_at_pixels();
  clear(0, 0, 0, 0);
  constexpr int kW = 9, kH = 5;
  const std::vector<Pixel> image = pattern(kW, kH);
  op::raster_pos(gl(), 4, 3, 0, 1);
  op::draw_pixels(gl(), kW, kH, GL_RGBA, GL_UNSIGNED_BYTE, image.data());
  EXPECT_GL(GL_NO_ERROR);
  const std::vector<Pixel> out = read();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool inside = x >= 4 && x < 4 + kW && y >= 3 && y < 3 + kH;
      const Pixel expected = inside ? image[size_t((y - 3) * kW + x - 4)] : Pixel{0, 0, 0, 0};
      ASSERT_EQ(out[size_t(y * kWidth + x)], expected) << x << " " << y;
    }
  }
}

// Every zoom against the rule of the specification, in exact arithmetic: positions and zooms are dyadic.
TEST_F(PixelDrawTest, ZoomsAsTheRuleSays) {
  look_at_pixels();
  constexpr int kW = 7, kH = 4;
  const std::vector<Pixel> image = pattern(kW, kH);
  const float zooms[] = {1, 2, 3.5f, 0.5f, 0.25f, -1, -2, -0.5f, 1.25f, 40, -40, 0};
  for (float zx : zooms) {
    for (float zy : {1.0f, -1.5f, 0.75f}) {
      for (const auto& at : {std::array<float, 2>{12, 9}, {8.5f, 8.25f}}) {
        clear(0, 0, 0, 0);
        op::raster_pos(gl(), at[0], at[1], 0, 1);
        op::pixel_zoom(gl(), zx, zy);
        op::draw_pixels(gl(), kW, kH, GL_RGBA, GL_UNSIGNED_BYTE, image.data());
        const std::vector<Pixel> out = read();
        for (int y = 0; y < kHeight; ++y) {
          for (int x = 0; x < kWidth; ++x) {
            Pixel expected{0, 0, 0, 0};
            for (int j = 0; j < kH; ++j) {
              for (int i = 0; i < kW; ++i) {
                const double x0 = double(at[0]) + double(zx) * i, x1 = double(at[0]) + double(zx) * (i + 1);
                const double y0 = double(at[1]) + double(zy) * j, y1 = double(at[1]) + double(zy) * (j + 1);
                const bool in_x = x + 0.5 >= std::min(x0, x1) && x + 0.5 < std::max(x0, x1);
                const bool in_y = y + 0.5 >= std::min(y0, y1) && y + 0.5 < std::max(y0, y1);
                if (in_x && in_y) expected = image[size_t(j * kW + i)];
              }
            }
            ASSERT_EQ(out[size_t(y * kWidth + x)], expected) << zx << " " << zy << " at " << x << " " << y;
          }
        }
      }
    }
  }
}

// Parts of an image that lie outside the window are left out, whatever its size.
TEST_F(PixelDrawTest, ImagesMayBeLargerThanTheWindow) {
  look_at_pixels();
  clear(0, 0, 0, 0);
  constexpr int kW = 700, kH = 400;
  const std::vector<Pixel> image = pattern(kW, kH);
  op::raster_pos(gl(), 0, 0, 0, 1);
  const uint8_t nothing = 0;
  op::bitmap(gl(), 0, 0, 0, 0, -310, -203, &nothing);  // how a position outside the window is reached
  op::draw_pixels(gl(), kW, kH, GL_RGBA, GL_UNSIGNED_BYTE, image.data());
  const std::vector<Pixel> out = read();
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      ASSERT_EQ(out[size_t(y * kWidth + x)], image[size_t((y + 203) * kW + x + 310)]);
}

TEST_F(PixelDrawTest, PixelsTakePartInTheOrderOfDrawing) {
  look_at_pixels();
  clear(0, 0, 0, 0);
  const std::vector<Pixel> image(100, Pixel{10, 20, 30, 40});
  op::color(gl(), 1, 0, 0, 1);
  op::rect(gl(), 0, 0, 10, 10);
  op::raster_pos(gl(), 5, 5, 0, 1);
  op::draw_pixels(gl(), 10, 10, GL_RGBA, GL_UNSIGNED_BYTE, image.data());
  op::color(gl(), 0, 1, 0, 1);
  op::rect(gl(), 8, 8, 12, 12);
  const std::vector<Pixel> out = read();
  EXPECT_EQ(out[4 * kWidth + 4], (Pixel{255, 0, 0, 255}));
  EXPECT_EQ(out[5 * kWidth + 5], (Pixel{10, 20, 30, 40}));
  EXPECT_EQ(out[9 * kWidth + 9], (Pixel{0, 255, 0, 255}));
  EXPECT_EQ(out[14 * kWidth + 14], (Pixel{10, 20, 30, 40}));
}

TEST_F(PixelDrawTest, FragmentsOfPixelsGoThroughAllStages) {
  look_at_pixels();
  clear(1, 1, 1, 1);
  op::scissor(gl(), 0, 0, 8, 20);
  op::enable(gl(), GL_SCISSOR_TEST);
  op::enable(gl(), GL_BLEND);
  op::blend_func(gl(), GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  op::color_mask(gl(), GL_TRUE, GL_TRUE, GL_FALSE, GL_TRUE);
  op::enable(gl(), GL_ALPHA_TEST);
  op::alpha_func(gl(), GL_GREATER, 0.25f);
  op::enable(gl(), GL_DEPTH_TEST);
  const std::vector<Pixel> image = {{0, 51, 0, 128}, {0, 0, 0, 10}};
  op::raster_pos(gl(), 2, 2, 0, 1);
  op::pixel_zoom(gl(), 4, 4);
  op::draw_pixels(gl(), 2, 1, GL_RGBA, GL_UNSIGNED_BYTE, image.data());
  op::raster_pos(gl(), 2, 2, -1, 1);  // deeper than what is there: fails
  op::draw_pixels(gl(), 2, 1, GL_RGBA, GL_UNSIGNED_BYTE, image.data());
  const std::vector<Pixel> out = read();
  const auto mix = [](int s, int d) { return uint8_t(std::floor((s * 128 + d * 127) / 255.0 + 0.5)); };
  EXPECT_EQ(out[3 * kWidth + 3], (Pixel{mix(0, 255), mix(51, 255), 255, mix(128, 255)}));
  EXPECT_EQ(out[3 * kWidth + 7], (Pixel{255, 255, 255, 255}));  // alpha
  const std::vector<uint32_t> depth = read_depth();
  EXPECT_EQ(depth[3 * kWidth + 3], 8388608u);
  EXPECT_EQ(depth[3 * kWidth + 7], 0xFFFFFFu);
}

TEST_F(PixelDrawTest, DepthsAreTestedOneByOne) {
  look_at_pixels();
  clear(0, 0, 0, 0);
  op::clear_depth(gl(), 0.5);
  op::clear(gl(), GL_DEPTH_BUFFER_BIT);
  op::enable(gl(), GL_DEPTH_TEST);
  op::color(gl(), 0, 0.2f, 0.4f, 1);
  op::raster_pos(gl(), 1, 1, 0, 1);
  GLuint image[11 * 13];
  for (GLuint i = 0; i < 11 * 13; ++i) image[i] = i * 30000000u;
  op::draw_pixels(gl(), 11, 13, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, image);
  EXPECT_GL(GL_NO_ERROR);
  const std::vector<uint32_t> depth = read_depth();
  const std::vector<Pixel> color = read();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool inside = x >= 1 && x < 12 && y >= 1 && y < 14;
      const GLuint value = inside ? image[(y - 1) * 11 + x - 1] : ~0u;
      const auto d = uint32_t(std::floor(double(value) / 4294967295.0 * 16777215.0 + 0.5));
      const bool passes = d < 8388608u;
      ASSERT_EQ(depth[size_t(y * kWidth + x)], passes ? d : 8388608u) << x << " " << y;
      ASSERT_EQ(color[size_t(y * kWidth + x)], (passes ? Pixel{0, 51, 102, 255} : Pixel{0, 0, 0, 0}))
          << x << " " << y;
    }
  }
}

TEST_F(PixelDrawTest, BitmapsDrawTheirBitsAndMoveThePosition) {
  look_at_pixels();
  clear(0, 0, 0, 0);
  const uint8_t bits[3 * 2] = {0xA5, 0x81, 0xFF, 0xC3, 0x18, 0x01};  // 3 rows of 13
  op::color(gl(), 1, 0.2f, 0, 1);
  op::raster_pos(gl(), 10.75f, 6.25f, 0, 1);
  op::color(gl(), 0, 0, 0, 0);  // not what is drawn with
  op::pixel_zoom(gl(), 3, 3);   // not for bitmaps
  op::bitmap(gl(), 13, 3, 2.5f, 1, 14.5f, -2, bits);
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_EQ((get<GLfloat, 4>(GL_CURRENT_RASTER_POSITION)), (std::array<GLfloat, 4>{25.25f, 4.25f, 0.5f, 1}));
  const std::vector<Pixel> out = read();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int i = x - 8, j = y - 5;  // floor(10.75 - 2.5), floor(6.25 - 1)
      const bool set = i >= 0 && i < 13 && j >= 0 && j < 3 && (bits[j * 2 + i / 8] >> (7 - i % 8) & 1) != 0;
      ASSERT_EQ(out[size_t(y * kWidth + x)], (set ? Pixel{255, 51, 0, 255} : Pixel{0, 0, 0, 0}))
          << x << " " << y;
    }
  }
  op::raster_pos(gl(), -5, 0, 0, 1);
  op::bitmap(gl(), 13, 3, 0, 0, 7, 7, bits);
  EXPECT_FALSE(valid());
  EXPECT_EQ(read(), out);
}

TEST_F(PixelDrawTest, CopiesMayOverlap) {
  look_at_pixels();
  const std::vector<Pixel> image = pattern(kWidth, kHeight);
  op::raster_pos(gl(), 0, 0, 0, 1);
  op::draw_pixels(gl(), kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, image.data());
  op::raster_pos(gl(), 6, 4, 0, 1);
  op::copy_pixels(gl(), 2, 1, 25, 14, GL_COLOR);
  EXPECT_GL(GL_NO_ERROR);
  const std::vector<Pixel> out = read();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool inside = x >= 6 && x < 31 && y >= 4 && y < 18;
      const int from = inside ? (y - 3) * kWidth + x - 4 : y * kWidth + x;
      ASSERT_EQ(out[size_t(y * kWidth + x)], image[size_t(from)]) << x << " " << y;
    }
  }
  // From beyond the window's edge: what exists goes where it belongs.
  op::raster_pos(gl(), 3, 2, 0, 1);
  op::copy_pixels(gl(), -4, -3, 10, 9, GL_COLOR);
  const std::vector<Pixel> again = read();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool inside = x >= 7 && x < 13 && y >= 5 && y < 11;
      ASSERT_EQ(again[size_t(y * kWidth + x)],
                out[size_t(inside ? (y - 5) * kWidth + x - 7 : y * kWidth + x)]);
    }
  }
}

TEST_F(PixelDrawTest, CopiedPixelsAreTransferred) {
  look_at_pixels();
  clear(0.2f, 0.4f, 0.6f, 1);
  op::pixel_transfer(gl(), GL_RED_SCALE, 2);
  op::pixel_transfer(gl(), GL_GREEN_BIAS, 0.2);
  op::pixel_transfer(gl(), GL_BLUE_SCALE, 3);
  op::pixel_transfer(gl(), GL_DEPTH_SCALE, 0.5);
  op::raster_pos(gl(), 10, 10, 0, 1);
  op::copy_pixels(gl(), 0, 0, 3, 3, GL_COLOR);
  op::enable(gl(), GL_DEPTH_TEST);
  op::depth_func(gl(), GL_ALWAYS);
  op::color_mask(gl(), GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  op::copy_pixels(gl(), 0, 0, 3, 3, GL_DEPTH);
  op::pixel_transfer(gl(), GL_RED_SCALE, 1);
  op::pixel_transfer(gl(), GL_GREEN_BIAS, 0);
  op::pixel_transfer(gl(), GL_BLUE_SCALE, 1);
  op::pixel_transfer(gl(), GL_DEPTH_SCALE, 1);
  EXPECT_EQ(read()[11 * kWidth + 11], (Pixel{102, 153, 255, 255}));
  EXPECT_EQ(read()[9 * kWidth + 11], (Pixel{51, 102, 153, 255}));
  EXPECT_EQ(read_depth()[11 * kWidth + 11], 8388608u);  // half of 2^24 - 1, rounded up
  EXPECT_EQ(read_depth()[9 * kWidth + 11], 0xFFFFFFu);
}

TEST_F(PixelDrawTest, Refuses) {
  look_at_pixels();
  clear(0, 0, 0, 0);
  op::raster_pos(gl(), 1, 1, 0, 1);
  const uint8_t data[64] = {255};
  op::draw_pixels(gl(), -1, 1, GL_RGBA, GL_UNSIGNED_BYTE, data);
  EXPECT_GL(GL_INVALID_VALUE);
  op::draw_pixels(gl(), 1, -1, GL_RGBA, GL_UNSIGNED_BYTE, data);
  EXPECT_GL(GL_INVALID_VALUE);
  op::draw_pixels(gl(), 1, 1, GL_RGBA8, GL_UNSIGNED_BYTE, data);
  EXPECT_GL(GL_INVALID_ENUM);
  op::draw_pixels(gl(), 1, 1, GL_RGBA, GL_BITMAP, data);
  EXPECT_GL(GL_INVALID_ENUM);
  op::draw_pixels(gl(), 1, 1, GL_RGBA, GL_DOUBLE, data);
  EXPECT_GL(GL_INVALID_ENUM);
  op::draw_pixels(gl(), 1, 1, GL_RGBA, GL_UNSIGNED_BYTE_3_3_2, data);
  EXPECT_GL(GL_INVALID_OPERATION);
  op::bitmap(gl(), -1, 1, 0, 0, 5, 5, data);
  EXPECT_GL(GL_INVALID_VALUE);
  op::bitmap(gl(), 1, -1, 0, 0, 5, 5, data);
  EXPECT_GL(GL_INVALID_VALUE);
  EXPECT_EQ((get<GLfloat, 4>(GL_CURRENT_RASTER_POSITION))[0], 1.0f);
  op::copy_pixels(gl(), 0, 0, 1, 1, GL_RGBA);
  EXPECT_GL(GL_INVALID_ENUM);
  op::copy_pixels(gl(), 0, 0, -1, 1, GL_COLOR);
  EXPECT_GL(GL_INVALID_VALUE);
  op::copy_pixels(gl(), 0, 0, 1, -1, GL_COLOR);
  EXPECT_GL(GL_INVALID_VALUE);
  open({.depth_bits = 0, .stencil_bits = 0});
  op::draw_pixels(gl(), 1, 1, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, data);
  EXPECT_GL(GL_INVALID_OPERATION);
  op::copy_pixels(gl(), 0, 0, 1, 1, GL_STENCIL);
  EXPECT_GL(GL_INVALID_OPERATION);
  op::copy_pixels(gl(), 0, 0, 1, 1, GL_DEPTH);
  EXPECT_GL(GL_INVALID_OPERATION);
}

TEST_F(PixelDrawTest, IndicesBecomeColors) {
  look_at_pixels();
  clear(0, 0, 0, 0);
  const GLfloat red[4] = {0, 0.2f, 0.4f, 0.6f}, one[1] = {1};
  op::pixel_mapfv(gl(), GL_PIXEL_MAP_I_TO_R, 4, red);
  op::pixel_mapfv(gl(), GL_PIXEL_MAP_I_TO_A, 1, one);
  const GLushort indices[3] = {3, 5, 2};
  op::raster_pos(gl(), 0, 0, 0, 1);
  op::draw_pixels(gl(), 3, 1, GL_COLOR_INDEX, GL_UNSIGNED_SHORT, indices);
  const uint8_t bits = 0x40;
  op::raster_pos(gl(), 0, 1, 0, 1);
  op::draw_pixels(gl(), 2, 1, GL_COLOR_INDEX, GL_BITMAP, &bits);
  const std::vector<Pixel> out = read();
  EXPECT_EQ(out[0], (Pixel{153, 0, 0, 255}));
  EXPECT_EQ(out[1], (Pixel{51, 0, 0, 255}));
  EXPECT_EQ(out[2], (Pixel{102, 0, 0, 255}));
  EXPECT_EQ(out[kWidth], (Pixel{0, 0, 0, 255}));
  EXPECT_EQ(out[kWidth + 1], (Pixel{51, 0, 0, 255}));
}

}  // namespace
}  // namespace halfspace::state
