// Pixel transfer, pixel maps, and images taken out of client memory (spec 3.6.3 to 3.6.5).
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <random>
#include <vector>

#include "state/pixel_image.h"
#include "tests/unit/pixel_fixture.h"
#include "tests/unit/pixel_model.h"

namespace halfspace::state {
namespace {

using pixel_model::Real;

class PixelTransferTest : public PixelTest {
 protected:
  GLfloat get(GLenum name) {
    GLfloat v = -777;
    op::get_floatv(gl(), name, &v);
    EXPECT_GL(GL_NO_ERROR) << std::hex << name;
    return v;
  }
  PixelFormat describe(GLenum format, GLenum type) {
    PixelFormat out;
    EXPECT_EQ(describe_pixels(format, type, out), GLenum{GL_NO_ERROR});
    return out;
  }
  std::array<float, 4> read_one(GLenum format, GLenum type, const void* pixel) {
    ImageReader reader(gl(), describe(format, type), kPackedStore, 1, pixel);
    std::array<float, 4> rgba;
    reader.read_rgba(0, 0, 1, rgba.data());
    return rgba;
  }
};

constexpr GLenum kReals[] = {GL_RED_SCALE, GL_GREEN_SCALE, GL_BLUE_SCALE, GL_ALPHA_SCALE, GL_DEPTH_SCALE,
                             GL_RED_BIAS,  GL_GREEN_BIAS,  GL_BLUE_BIAS,  GL_ALPHA_BIAS,  GL_DEPTH_BIAS};

TEST_F(PixelTransferTest, EveryParameterIsItsOwn) {
  float value = 0.125f;
  for (GLenum name : kReals) {
    const bool scale = name == GL_RED_SCALE || name == GL_GREEN_SCALE || name == GL_BLUE_SCALE ||
                       name == GL_ALPHA_SCALE || name == GL_DEPTH_SCALE;
    EXPECT_EQ(get(name), scale ? 1.0f : 0.0f);
    op::pixel_transfer(gl(), name, double(value));
    value += 0.25f;
  }
  for (GLenum name :
       std::initializer_list<GLenum>{GL_MAP_COLOR, GL_MAP_STENCIL, GL_INDEX_SHIFT, GL_INDEX_OFFSET})
    EXPECT_EQ(get(name), 0);
  op::pixel_transfer(gl(), GL_MAP_COLOR, 0.25);
  op::pixel_transfer(gl(), GL_INDEX_SHIFT, -3.4);
  op::pixel_transfer(gl(), GL_INDEX_OFFSET, 2147483647.0);
  op::pixel_zoom(gl(), -0.5f, 3);
  value = 0.125f;
  for (GLenum name : kReals) {
    EXPECT_EQ(get(name), value);
    value += 0.25f;
  }
  EXPECT_EQ(get(GL_MAP_COLOR), 1);
  EXPECT_EQ(get(GL_MAP_STENCIL), 0);
  EXPECT_EQ(get(GL_INDEX_SHIFT), -3);
  GLint offset = 0;
  op::get_integerv(gl(), GL_INDEX_OFFSET, &offset);
  EXPECT_EQ(offset, 2147483647);
  EXPECT_EQ(get(GL_ZOOM_X), -0.5f);
  EXPECT_EQ(get(GL_ZOOM_Y), 3.0f);
  op::pixel_transfer(gl(), GL_ZOOM_X, 7);
  EXPECT_GL(GL_INVALID_ENUM);
  EXPECT_EQ(get(GL_ZOOM_X), -0.5f);
}

TEST_F(PixelTransferTest, MapsKeepWhatTheyAreGiven) {
  const GLuint colors[4] = {0, 0x40000000, 0xC0000001, 0xFFFFFFFF};
  const GLushort shorts[3] = {0, 21845, 65535};
  const GLfloat floats[2] = {-0.5f, 0.75f};
  op::pixel_mapuiv(gl(), GL_PIXEL_MAP_I_TO_G, 4, colors);
  op::pixel_mapusv(gl(), GL_PIXEL_MAP_B_TO_B, 3, shorts);
  op::pixel_mapfv(gl(), GL_PIXEL_MAP_A_TO_A, 2, floats);
  op::pixel_mapuiv(gl(), GL_PIXEL_MAP_S_TO_S, 2, colors);
  EXPECT_GL(GL_NO_ERROR);
  GLfloat f[4] = {};
  op::get_pixel_mapfv(gl(), GL_PIXEL_MAP_I_TO_G, f);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(f[i], float(double(colors[i]) / 4294967295.0));
  GLushort s[3] = {};
  op::get_pixel_mapusv(gl(), GL_PIXEL_MAP_B_TO_B, s);
  EXPECT_EQ(std::memcmp(s, shorts, sizeof s), 0);
  op::get_pixel_mapfv(gl(), GL_PIXEL_MAP_A_TO_A, f);
  EXPECT_EQ(f[0], 0.0f);  // components are clamped
  EXPECT_EQ(f[1], 0.75f);
  GLuint u[2] = {};
  op::get_pixel_mapuiv(gl(), GL_PIXEL_MAP_S_TO_S, u);
  EXPECT_EQ(u[1], 0x40000000u);  // indices are not
  EXPECT_EQ(get(GL_PIXEL_MAP_I_TO_G_SIZE), 4);
  EXPECT_EQ(get(GL_PIXEL_MAP_B_TO_B_SIZE), 3);
  EXPECT_EQ(get(GL_PIXEL_MAP_R_TO_R_SIZE), 1);
}

TEST_F(PixelTransferTest, MapsRefuse) {
  const GLfloat values[257] = {};
  GLfloat out[1] = {5};
  op::pixel_mapfv(gl(), GL_PIXEL_MAP_A_TO_A + 1, 2, values);
  EXPECT_GL(GL_INVALID_ENUM);
  op::get_pixel_mapfv(gl(), GL_PIXEL_MAP_I_TO_I - 1, out);
  EXPECT_GL(GL_INVALID_ENUM);
  EXPECT_EQ(out[0], 5);
  for (GLsizei size : {0, -1, 257}) {
    op::pixel_mapfv(gl(), GL_PIXEL_MAP_R_TO_R, size, values);
    EXPECT_GL(GL_INVALID_VALUE);
  }
  for (GLenum map = GL_PIXEL_MAP_I_TO_I; map <= GL_PIXEL_MAP_I_TO_A; ++map) {
    op::pixel_mapfv(gl(), map, 3, values);
    EXPECT_GL(GL_INVALID_VALUE);
    op::pixel_mapfv(gl(), map, 256, values);
    EXPECT_GL(GL_NO_ERROR);
  }
  op::pixel_mapfv(gl(), GL_PIXEL_MAP_R_TO_R, 3, values);
  EXPECT_GL(GL_NO_ERROR);
}

TEST_F(PixelTransferTest, ColorsAreScaledThenMapped) {
  const float pixel[4] = {0.5f, 0.25f, 0.75f, 1.0f};
  op::pixel_transfer(gl(), GL_RED_SCALE, 2);
  op::pixel_transfer(gl(), GL_GREEN_BIAS, -0.125);
  op::pixel_transfer(gl(), GL_BLUE_SCALE, -1);
  op::pixel_transfer(gl(), GL_ALPHA_SCALE, 0.5);
  op::pixel_transfer(gl(), GL_ALPHA_BIAS, 1);
  EXPECT_EQ(read_one(GL_RGBA, GL_FLOAT, pixel), (std::array<float, 4>{1, 0.125f, 0, 1}));
  // A map of n entries takes c to entry round(c * (n - 1)).
  const float three[3] = {0.1f, 0.2f, 0.3f}, four[4] = {0.9f, 0.8f, 0.7f, 0.6f};
  op::pixel_mapfv(gl(), GL_PIXEL_MAP_R_TO_R, 3, three);
  op::pixel_mapfv(gl(), GL_PIXEL_MAP_G_TO_G, 4, four);
  EXPECT_EQ(read_one(GL_RGBA, GL_FLOAT, pixel)[0], 1.0f);  // not yet
  op::pixel_transfer(gl(), GL_MAP_COLOR, 1);
  EXPECT_EQ(read_one(GL_RGBA, GL_FLOAT, pixel), (std::array<float, 4>{0.3f, 0.9f, 0, 0}));
  op::pixel_transfer(gl(), GL_GREEN_BIAS, 0);
  EXPECT_EQ(read_one(GL_RGBA, GL_FLOAT, pixel)[1], 0.8f);
  // Floats beyond [0, 1], and those that are none, find an entry as well.
  const float wild[4] = {std::numeric_limits<float>::infinity(), -5, std::numeric_limits<float>::quiet_NaN(),
                         9};
  EXPECT_EQ(read_one(GL_RGBA, GL_FLOAT, wild), (std::array<float, 4>{0.3f, 0.9f, 0, 0}));
}

TEST_F(PixelTransferTest, IndicesAreShiftedOffsetAndMapped) {
  float table[8], green[2] = {0.25f, 0.5f};
  for (int i = 0; i < 8; ++i) table[i] = float(i) / 8;
  op::pixel_mapfv(gl(), GL_PIXEL_MAP_I_TO_R, 8, table);
  op::pixel_mapfv(gl(), GL_PIXEL_MAP_I_TO_G, 2, green);
  const uint8_t index = 5;
  EXPECT_EQ(read_one(GL_COLOR_INDEX, GL_UNSIGNED_BYTE, &index), (std::array<float, 4>{0.625f, 0.5f, 0, 0}));
  op::pixel_transfer(gl(), GL_INDEX_SHIFT, 1);
  op::pixel_transfer(gl(), GL_INDEX_OFFSET, 1);
  EXPECT_EQ(read_one(GL_COLOR_INDEX, GL_UNSIGNED_BYTE, &index)[0], 3.0f / 8);  // 11 & 7
  op::pixel_transfer(gl(), GL_INDEX_SHIFT, -1);
  op::pixel_transfer(gl(), GL_RED_SCALE, 0);                                   // for components only
  EXPECT_EQ(read_one(GL_COLOR_INDEX, GL_UNSIGNED_BYTE, &index)[0], 3.0f / 8);  // 2 + 1
  for (GLint shift : {64, -64, 2147483647, INT32_MIN}) {
    op::pixel_transfer(gl(), GL_INDEX_SHIFT, shift);
    EXPECT_EQ(read_one(GL_COLOR_INDEX, GL_UNSIGNED_BYTE, &index)[0], 1.0f / 8) << shift;
  }
}

TEST_F(PixelTransferTest, StencilAndDepth) {
  const int16_t index = 0x1A5;
  ImageReader stencil(gl(), describe(GL_STENCIL_INDEX, GL_SHORT), kPackedStore, 1, &index);
  uint8_t s = 0;
  stencil.read_stencil(0, 0, 1, &s);
  EXPECT_EQ(s, 0xA5);
  op::pixel_transfer(gl(), GL_INDEX_SHIFT, -4);
  op::pixel_transfer(gl(), GL_INDEX_OFFSET, 2);
  stencil.read_stencil(0, 0, 1, &s);
  EXPECT_EQ(s, 0x1C);
  const GLuint map[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 77, 13, 14, 15};
  op::pixel_mapuiv(gl(), GL_PIXEL_MAP_S_TO_S, 16, map);
  op::pixel_transfer(gl(), GL_MAP_STENCIL, 1);
  stencil.read_stencil(0, 0, 1, &s);
  EXPECT_EQ(s, 77);

  const uint16_t value = 0x8000;
  ImageReader depth(gl(), describe(GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT), kPackedStore, 1, &value);
  uint32_t d = 0;
  depth.read_depth(0, 0, 1, &d);
  EXPECT_EQ(d, uint32_t(pixel_model::round_half_up(Real(0x8000) * 16777215 / 65535)));
  op::pixel_transfer(gl(), GL_DEPTH_SCALE, 3);
  depth.read_depth(0, 0, 1, &d);
  EXPECT_EQ(d, 0xFFFFFFu);
  op::pixel_transfer(gl(), GL_DEPTH_BIAS, -2);
  depth.read_depth(0, 0, 1, &d);
  EXPECT_EQ(d, 0u);
}

TEST_F(PixelTransferTest, BitmapsLieAsTheStoreSays) {
  std::mt19937 random(3);
  std::vector<uint8_t> bytes(400);
  for (uint8_t& b : bytes) b = uint8_t(random());
  const PixelFormat format = describe(GL_COLOR_INDEX, GL_BITMAP);
  const float red[2] = {0.0f, 1.0f};
  op::pixel_mapfv(gl(), GL_PIXEL_MAP_I_TO_R, 2, red);
  for (int alignment : {1, 2, 4, 8}) {
    for (bool lsb_first : {false, true}) {
      for (int row_length : {0, 43}) {
        for (int skip : {0, 3, 17}) {
          const PixelStore store{.lsb_first = lsb_first,
                                 .row_length = row_length,
                                 .skip_rows = 1,
                                 .skip_pixels = skip,
                                 .alignment = alignment};
          constexpr int kW = 19, kH = 5;
          const size_t bits = size_t(row_length > 0 ? row_length : kW), a = size_t(alignment);
          const size_t row_bytes = a * size_t(std::ceil(double(bits) / (8 * double(a))));
          ImageReader reader(gl(), format, store, kW, bytes.data());
          const std::vector<std::byte> packed = unpack_image(format, store, kW, kH, bytes.data());
          ASSERT_EQ(packed.size(), size_t(3 * kH));
          for (int y = 0; y < kH; ++y) {
            float rgba[kW * 4];
            reader.read_rgba(0, y, kW, rgba);
            for (int x = 0; x < kW; ++x) {
              const size_t bit = size_t(skip + x);
              const unsigned byte = bytes[size_t(y + 1) * row_bytes + bit / 8];
              const bool set = (byte >> (lsb_first ? bit % 8 : 7 - bit % 8) & 1) != 0;
              ASSERT_EQ(rgba[4 * x], set ? 1.0f : 0.0f)
                  << alignment << lsb_first << row_length << " " << skip;
              const unsigned kept = std::to_integer<unsigned>(packed[size_t(3 * y + x / 8)]);
              ASSERT_EQ((kept >> (7 - x % 8) & 1) != 0, set);
            }
          }
        }
      }
    }
  }
}

TEST_F(PixelTransferTest, UnpackedImagesReadAsBefore) {
  std::mt19937 random(4);
  std::vector<uint8_t> bytes(20000);
  for (uint8_t& b : bytes) b = uint8_t(random());
  const PixelStore store{
      .swap_bytes = true, .row_length = 13, .skip_rows = 2, .skip_pixels = 3, .alignment = 8};
  constexpr int kW = 9, kH = 4;
  const auto same = [&](GLenum format, GLenum type) {
    const PixelFormat described = describe(format, type);
    const std::vector<std::byte> packed = unpack_image(described, store, kW, kH, bytes.data());
    ASSERT_EQ(packed.size(), size_t(kW * kH * described.pixel_bytes));
    ImageReader before(gl(), described, store, kW, bytes.data());
    ImageReader after(gl(), described, kPackedStore, kW, packed.data());
    for (int y = 0; y < kH; ++y) {
      uint8_t a[kW * 4], b[kW * 4];
      before.read_rgba8(0, y, kW, a);
      after.read_rgba8(0, y, kW, b);
      ASSERT_EQ(std::memcmp(a, b, sizeof a), 0) << std::hex << format << " " << type;
    }
  };
  for (const auto& format : pixel_model::kFormats)
    for (const auto& type : pixel_model::kTypes) same(format.format, type.type);
  for (const auto& type : pixel_model::kPackedTypes)
    same(type.widths.size() == 3 ? GL_RGB : GL_BGRA, type.type);
  EXPECT_TRUE(unpack_image(describe(GL_RGB, GL_FLOAT), store, 0, 5, bytes.data()).empty());
  EXPECT_TRUE(unpack_image(describe(GL_RGB, GL_FLOAT), store, 5, 5, nullptr).empty());
}

TEST_F(PixelTransferTest, TexturesAreTransferred) {
  const uint8_t texels[2 * 4] = {0, 51, 102, 255, 255, 204, 51, 0};
  op::pixel_transfer(gl(), GL_RED_BIAS, 0.2);
  op::pixel_transfer(gl(), GL_GREEN_SCALE, 2);
  op::tex_image_2d(gl(), GL_TEXTURE_2D, 0, GL_RGBA, 2, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
  op::pixel_transfer(gl(), GL_RED_BIAS, 0);
  op::pixel_transfer(gl(), GL_GREEN_SCALE, 1);
  uint8_t out[8] = {};
  op::get_tex_image(gl(), GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, out);
  const uint8_t expected[8] = {51, 102, 102, 255, 255, 255, 51, 0};
  EXPECT_EQ(std::memcmp(out, expected, 8), 0);
  EXPECT_GL(GL_NO_ERROR);
}

}  // namespace
}  // namespace halfspace::state
