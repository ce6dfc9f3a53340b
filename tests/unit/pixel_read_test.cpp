// glReadPixels and glClear (spec 4.2.3, 4.3.2).
#include <cstring>
#include <limits>
#include <vector>

#include "tests/unit/pixel_fixture.h"
#include "tests/unit/pixel_model.h"

namespace halfspace::state {
namespace {

using Bytes = std::vector<uint8_t>;

class PixelReadTest : public PixelTest {
 protected:
  // Every pixel its own colour and depth, made of one scissored clear a pixel.
  static std::array<uint8_t, 4> color_at(int x, int y) {
    return {uint8_t(x * 6 + 3), uint8_t(y * 11 + 2), uint8_t(x * y), uint8_t(255 - x - y * 3)};
  }
  static uint32_t depth_at(int x, int y) { return uint32_t(x * 453377 + y * 1777 + 5) & 0xFFFFFF; }
  void paint() {
    gl().scissor.test = true;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const auto c = color_at(x, y);
        op::scissor(gl(), x, y, 1, 1);
        op::clear_color(gl(), float(c[0]) / 255, float(c[1]) / 255, float(c[2]) / 255, float(c[3]) / 255);
        op::clear_depth(gl(), depth_at(x, y) / 16777215.0);
        op::clear(gl(), GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
      }
    }
    gl().scissor.test = false;
    EXPECT_GL(GL_NO_ERROR);
  }
  void read(GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type, void* out) {
    op::read_pixels(gl(), x, y, width, height, format, type, out);
  }
  std::array<uint8_t, 4> pixel(int x, int y) {
    std::array<uint8_t, 4> out{};
    read(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, out.data());
    return out;
  }
  GLfloat depth(int x, int y) {
    GLfloat out = -1;
    read(x, y, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &out);
    return out;
  }
  void clear_to(float r, float g, float b, float a) {
    op::clear_color(gl(), r, g, b, a);
    op::clear(gl(), GL_COLOR_BUFFER_BIT);
  }
};

TEST_F(PixelReadTest, BytesComeBackAsTheyAre) {
  paint();
  Bytes out(kWidth * kHeight * 4);
  read(0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, out.data());
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      ASSERT_EQ(std::memcmp(&out[size_t(y * kWidth + x) * 4], color_at(x, y).data(), 4), 0) << x << " " << y;
    }
  }
}

TEST_F(PixelReadTest, EveryFormatAndType) {
  using namespace pixel_model;
  paint();
  constexpr int kX = 5, kY = 3, kW = 9, kH = 7;
  for (const FormatRow& format : kFormats) {
    for (const TypeRow& type : kTypes) {
      const size_t size = size_t(type.bits) / 8, n = format.components.size();
      const size_t row_bytes = (kW * n * size + 3) / 4 * 4;
      pixel_model::Bytes out(row_bytes * kH);
      read(kX, kY, kW, kH, format.format, type.type, out.data());
      EXPECT_GL(GL_NO_ERROR);
      for (int y = 0; y < kH; ++y) {
        for (int x = 0; x < kW; ++x) {
          const auto color = color_at(kX + x, kY + y);
          const Rgba over = {Real(color[0]), Real(color[1]), Real(color[2]), Real(color[3])};
          for (size_t c = 0; c < n; ++c) {
            const Real sum = std::min<Real>(over[0] + over[1] + over[2], 255);
            const Real numerator = format.components[c] == 'L' ? sum : picked(format.components[c], over);
            const size_t at = size_t(y) * row_bytes + (size_t(x) * n + c) * size;
            ASSERT_EQ(read_element(&out[at], size, false), element_of(type, numerator, 255))
                << format.components << " type " << std::hex << type.type << " at " << x << " " << y;
          }
        }
      }
    }
  }
}

TEST_F(PixelReadTest, DepthOfEveryType) {
  using namespace pixel_model;
  paint();
  for (const TypeRow& type : kTypes) {
    const size_t size = size_t(type.bits) / 8;
    op::pixel_storei(gl(), GL_PACK_ALIGNMENT, 1);
    pixel_model::Bytes out(size_t(kWidth * kHeight) * size);
    read(0, 0, kWidth, kHeight, GL_DEPTH_COMPONENT, type.type, out.data());
    EXPECT_GL(GL_NO_ERROR);
    for (int i = 0; i < kWidth * kHeight; ++i) {
      const uint32_t expected = depth_at(i % kWidth, i / kWidth);
      ASSERT_EQ(read_element(&out[size_t(i) * size], size, false), element_of(type, expected, 16777215))
          << "type " << std::hex << type.type << " pixel " << i;
    }
  }
}

TEST_F(PixelReadTest, PackStoreAndSwap) {
  paint();
  op::pixel_storei(gl(), GL_PACK_ROW_LENGTH, 11);
  op::pixel_storei(gl(), GL_PACK_SKIP_PIXELS, 3);
  op::pixel_storei(gl(), GL_PACK_SKIP_ROWS, 2);
  op::pixel_storei(gl(), GL_PACK_ALIGNMENT, 8);
  op::pixel_storei(gl(), GL_PACK_SWAP_BYTES, 1);
  constexpr size_t kRowBytes = 72;  // 11 * 6 rounded up to 8
  constexpr int kX = 4, kY = 6, kW = 8, kH = 5;
  Bytes out(kRowBytes * (kH + 3), 0xCD), expected = out;
  read(kX, kY, kW, kH, GL_RGB, GL_UNSIGNED_SHORT, out.data());
  for (int y = 0; y < kH; ++y) {
    for (int x = 0; x < kW; ++x) {
      for (size_t c = 0; c < 3; ++c) {
        // 257 * v is the byte twice: swapping it changes nothing, so its place is what counts here.
        uint8_t* at = &expected[(size_t(y) + 2) * kRowBytes + (size_t(x) + 3) * 6 + c * 2];
        at[0] = at[1] = color_at(kX + x, kY + y)[c];
      }
    }
  }
  EXPECT_EQ(out, expected);

  uint16_t swapped = 0, straight = 0;
  op::pixel_storei(gl(), GL_PACK_SKIP_PIXELS, 0);
  op::pixel_storei(gl(), GL_PACK_SKIP_ROWS, 0);
  read(9, 9, 1, 1, GL_RGB, GL_UNSIGNED_SHORT_5_6_5, &swapped);
  op::pixel_storei(gl(), GL_PACK_SWAP_BYTES, 0);
  read(9, 9, 1, 1, GL_RGB, GL_UNSIGNED_SHORT_5_6_5, &straight);
  EXPECT_EQ(swapped, uint16_t(straight << 8 | straight >> 8));
  EXPECT_NE(swapped, straight);
}

TEST_F(PixelReadTest, PixelsOutsideTheWindowAreLeftAlone) {
  paint();
  op::pixel_storei(gl(), GL_PACK_ALIGNMENT, 1);
  struct Window {
    int x, y, width, height;
  };
  for (const Window& w : {Window{-4, -3, 12, 9}, Window{kWidth - 5, kHeight - 2, 11, 6},
                          Window{-2, -2, 50, 40}, Window{100, 0, 4, 4}, Window{-9, 0, 4, 4}}) {
    for (GLenum format : {GLenum{GL_RGBA}, GLenum{GL_RGB}, GLenum{GL_DEPTH_COMPONENT}}) {
      const size_t n = format == GL_RGBA ? 4 : format == GL_RGB ? 3 : 1;
      Bytes out(size_t(w.width * w.height) * n, 0xCD);
      read(w.x, w.y, w.width, w.height, format, GL_UNSIGNED_BYTE, out.data());
      for (int y = 0; y < w.height; ++y) {
        for (int x = 0; x < w.width; ++x) {
          const int wx = w.x + x, wy = w.y + y;
          const bool inside = wx >= 0 && wy >= 0 && wx < kWidth && wy < kHeight;
          for (size_t c = 0; c < n; ++c) {
            int expected = 0xCD;
            if (inside && n == 1)
              expected = int(pixel_model::round_half_up(255.0L * depth_at(wx, wy) / 16777215));
            if (inside && n != 1) expected = color_at(wx, wy)[c];
            ASSERT_EQ(int(out[size_t(y * w.width + x) * n + c]), expected) << wx << " " << wy;
          }
        }
      }
    }
  }
}

TEST_F(PixelReadTest, FarAwayRectanglesDoNotOverflow) {
  constexpr GLint kMin = std::numeric_limits<GLint>::min(), kMax = std::numeric_limits<GLint>::max();
  uint8_t byte = 0xCD;
  read(kMin, kMin, kMax, kMax, GL_RGBA, GL_UNSIGNED_BYTE, &byte);
  read(kMax, kMax, kMax, kMax, GL_RGBA, GL_UNSIGNED_BYTE, &byte);
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_EQ(byte, 0xCD);
}

TEST_F(PixelReadTest, Refuses) {
  uint8_t out[64];
  std::memset(out, 0xCD, sizeof out);
  const auto refused = [&](GLsizei width, GLsizei height, GLenum format, GLenum type, GLenum code) {
    read(0, 0, width, height, format, type, out);
    EXPECT_GL(code) << std::hex << format << " " << type;
  };
  refused(-1, 1, GL_RGBA, GL_UNSIGNED_BYTE, GL_INVALID_VALUE);
  refused(1, -1, GL_RGBA, GL_UNSIGNED_BYTE, GL_INVALID_VALUE);
  refused(1, 1, GL_RGBA8, GL_UNSIGNED_BYTE, GL_INVALID_ENUM);
  refused(1, 1, GL_RGBA, GL_DOUBLE, GL_INVALID_ENUM);
  refused(1, 1, GL_RGBA, GL_BITMAP, GL_INVALID_ENUM);
  refused(1, 1, GL_RGB, GL_UNSIGNED_INT_8_8_8_8, GL_INVALID_OPERATION);
  refused(1, 1, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, GL_INVALID_OPERATION);
  refused(1, 1, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, GL_INVALID_OPERATION);
  open({.depth_bits = 0});
  refused(1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, GL_INVALID_OPERATION);
  for (uint8_t byte : out) EXPECT_EQ(byte, 0xCD);
}

TEST_F(PixelReadTest, WhatIsReadIsTransferred) {
  clear_to(0.2f, 0.4f, 0.6f, 0.8f);
  op::clear_depth(gl(), 0.5);
  op::clear(gl(), GL_DEPTH_BUFFER_BIT);
  op::pixel_transfer(gl(), GL_RED_SCALE, 2);
  op::pixel_transfer(gl(), GL_GREEN_BIAS, 0.2);
  op::pixel_transfer(gl(), GL_BLUE_SCALE, -1);
  op::pixel_transfer(gl(), GL_DEPTH_SCALE, 0.5);
  EXPECT_EQ(pixel(1, 1), (std::array<uint8_t, 4>{102, 153, 0, 204}));
  EXPECT_NEAR(depth(1, 1), 0.25f, 1e-7f);
  GLfloat sum = 0;  // conversion to luminance comes before any clamping
  read(1, 1, 1, 1, GL_LUMINANCE, GL_FLOAT, &sum);
  EXPECT_NEAR(sum, 0.4f + 0.6f - 0.6f, 1e-6f);
}

TEST_F(PixelReadTest, StencilIndices) {
  open({.stencil_bits = 8});
  op::clear_stencil(gl(), 0xa5);
  op::clear(gl(), GL_STENCIL_BUFFER_BIT);
  uint8_t byte = 0;
  read(2, 2, 1, 1, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, &byte);
  EXPECT_EQ(byte, 0xa5);
  GLfloat real = 0;
  read(2, 2, 1, 1, GL_STENCIL_INDEX, GL_FLOAT, &real);
  EXPECT_EQ(real, 165.0f);
  int8_t small = 0;
  read(2, 2, 1, 1, GL_STENCIL_INDEX, GL_BYTE, &small);
  EXPECT_EQ(small, 0x25);  // table 4.6: seven bits
  op::pixel_transfer(gl(), GL_INDEX_SHIFT, 2);
  GLushort wide = 0;
  read(2, 2, 1, 1, GL_STENCIL_INDEX, GL_UNSIGNED_SHORT, &wide);
  EXPECT_EQ(wide, 0xa5 << 2);
  op::pixel_transfer(gl(), GL_INDEX_SHIFT, 0);
  // Bits: pixels 1, 2 and 3 of a row go behind six that are skipped.
  uint8_t bits[2] = {0, 0xff};
  op::scissor(gl(), 2, 2, 1, 1);
  op::enable(gl(), GL_SCISSOR_TEST);
  op::clear_stencil(gl(), 2);
  op::clear(gl(), GL_STENCIL_BUFFER_BIT);
  op::pixel_storei(gl(), GL_PACK_SKIP_PIXELS, 6);
  read(1, 2, 3, 1, GL_STENCIL_INDEX, GL_BITMAP, bits);
  EXPECT_EQ(bits[0], 0x02);
  EXPECT_EQ(bits[1], 0xff);
  op::pixel_storei(gl(), GL_PACK_LSB_FIRST, 1);
  bits[0] = 0, bits[1] = 0;
  read(1, 2, 3, 1, GL_STENCIL_INDEX, GL_BITMAP, bits);
  EXPECT_EQ(bits[0], 0x40);
  EXPECT_EQ(bits[1], 0x01);
  EXPECT_GL(GL_NO_ERROR);
}

TEST_F(PixelReadTest, AVisualWithoutAlphaReadsOne) {
  open({.alpha_bits = 0});
  clear_to(0.2f, 0.4f, 0.6f, 0);
  EXPECT_EQ(pixel(1, 1), (std::array<uint8_t, 4>{51, 102, 153, 255}));
  float out[4] = {};
  read(1, 1, 1, 1, GL_BGRA, GL_FLOAT, out);
  EXPECT_EQ(out[3], 1.0f);
  EXPECT_EQ(out[0], 153.0f / 255);
}

TEST_F(PixelReadTest, FloatBuffersKeepWhatBytesCannot) {
  open({}, raster::ColorFormat::rgba32f);
  clear_to(0.1f, 0.3f, 1e-4f, 0.7f);
  float out[4] = {};
  read(2, 2, 1, 1, GL_RGBA, GL_FLOAT, out);
  EXPECT_EQ(out[0], 0.1f);
  EXPECT_EQ(out[1], 0.3f);
  EXPECT_EQ(out[2], 1e-4f);
  EXPECT_EQ(out[3], 0.7f);
  uint16_t shorts[3] = {};
  read(2, 2, 1, 1, GL_RGB, GL_UNSIGNED_SHORT, shorts);
  EXPECT_EQ(shorts[2], 7);  // 1e-4 * 65535
  EXPECT_EQ(pixel(2, 2), (std::array<uint8_t, 4>{26, 77, 0, 179}));
}

TEST_F(PixelReadTest, TheReadBufferSaysWhere) {
  open({.double_buffered = true});
  op::draw_buffer(gl(), GL_FRONT);
  clear_to(1, 0, 0, 1);
  op::draw_buffer(gl(), GL_BACK);
  clear_to(0, 1, 0, 1);
  EXPECT_EQ(pixel(0, 0)[1], 255);
  op::read_buffer(gl(), GL_FRONT);
  EXPECT_EQ(pixel(0, 0)[0], 255);
  EXPECT_EQ(pixel(0, 0)[1], 0);
  clear_to(0, 0, 1, 1);  // still drawn to the back
  EXPECT_EQ(pixel(0, 0)[2], 0);
  op::read_buffer(gl(), GL_BACK);
  EXPECT_EQ(pixel(0, 0)[2], 255);
  EXPECT_GL(GL_NO_ERROR);
}

TEST_F(PixelReadTest, ClearRefusesUnknownBits) {
  clear_to(0, 0, 0, 0);
  op::clear_color(gl(), 1, 1, 1, 1);
  op::clear(gl(), GL_COLOR_BUFFER_BIT | 1);
  EXPECT_GL(GL_INVALID_VALUE);
  EXPECT_EQ(pixel(3, 3)[0], 0);
  op::clear(gl(), GL_STENCIL_BUFFER_BIT | GL_ACCUM_BUFFER_BIT);  // not there: nothing happens
  EXPECT_GL(GL_NO_ERROR);
  op::clear(gl(), 0);
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_EQ(pixel(3, 3)[0], 0);
}

TEST_F(PixelReadTest, ClearObeysScissorAndMasks) {
  clear_to(0, 0, 0, 0);
  op::clear_depth(gl(), 0.25);
  op::clear(gl(), GL_DEPTH_BUFFER_BIT);
  op::color_mask(gl(), GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
  op::scissor(gl(), 2, 3, 5, 4);
  op::enable(gl(), GL_SCISSOR_TEST);
  clear_to(1, 1, 1, 1);
  op::depth_mask(gl(), GL_FALSE);
  op::clear_depth(gl(), 0.75);
  op::clear(gl(), GL_DEPTH_BUFFER_BIT);
  EXPECT_EQ(depth(4, 4), depth(0, 0));
  op::depth_mask(gl(), GL_TRUE);
  op::clear(gl(), GL_DEPTH_BUFFER_BIT);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool inside = x >= 2 && x < 7 && y >= 3 && y < 7;
      const uint8_t on = inside ? 255 : 0;
      ASSERT_EQ(pixel(x, y), (std::array<uint8_t, 4>{on, 0, on, 0})) << x << " " << y;
      ASSERT_NEAR(depth(x, y), inside ? 0.75 : 0.25, 1e-7) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace halfspace::state
