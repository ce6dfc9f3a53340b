// glTexImage2D, glTexSubImage2D, glGetTexImage, level queries, proxies (spec 3.8.1, 3.8.2, 6.1.3, 6.1.4).
#include <array>
#include <cstring>
#include <vector>

#include "raster/texture/level.h"
#include "tests/unit/pixel_fixture.h"
#include "tests/unit/pixel_model.h"

namespace halfspace::state {
namespace {

using Texel = std::array<int, 4>;
using Texels = std::vector<uint8_t>;

// Components a base format keeps (spec table 3.15), and what glGetTexImage gives for the others (table 6.1):
// R, G, B, A, each either a component of the source or a constant.
struct InternalFormat {
  GLint name;
  const char* kept;  // of RGBALI, what has bits
  int from[4];       // 0..3 component of the source, kZero, kOne
};
constexpr int kZero = -1, kOne = -2;
constexpr int kA[] = {kZero, kZero, kZero, 3}, kL[] = {0, kZero, kZero, kOne}, kLA[] = {0, kZero, kZero, 3},
              kRgb[] = {0, 1, 2, kOne}, kRgba[] = {0, 1, 2, 3};
#define AS(row) \
  { row[0], row[1], row[2], row[3] }
const std::vector<InternalFormat> kInternalFormats = {
    {1, "L", AS(kL)},
    {2, "LA", AS(kLA)},
    {3, "RGB", AS(kRgb)},
    {4, "RGBA", AS(kRgba)},
    {GL_ALPHA, "A", AS(kA)},
    {GL_ALPHA4, "A", AS(kA)},
    {GL_ALPHA8, "A", AS(kA)},
    {GL_ALPHA12, "A", AS(kA)},
    {GL_ALPHA16, "A", AS(kA)},
    {GL_LUMINANCE, "L", AS(kL)},
    {GL_LUMINANCE4, "L", AS(kL)},
    {GL_LUMINANCE8, "L", AS(kL)},
    {GL_LUMINANCE12, "L", AS(kL)},
    {GL_LUMINANCE16, "L", AS(kL)},
    {GL_LUMINANCE_ALPHA, "LA", AS(kLA)},
    {GL_LUMINANCE4_ALPHA4, "LA", AS(kLA)},
    {GL_LUMINANCE6_ALPHA2, "LA", AS(kLA)},
    {GL_LUMINANCE8_ALPHA8, "LA", AS(kLA)},
    {GL_LUMINANCE12_ALPHA4, "LA", AS(kLA)},
    {GL_LUMINANCE12_ALPHA12, "LA", AS(kLA)},
    {GL_LUMINANCE16_ALPHA16, "LA", AS(kLA)},
    {GL_INTENSITY, "I", AS(kL)},
    {GL_INTENSITY4, "I", AS(kL)},
    {GL_INTENSITY8, "I", AS(kL)},
    {GL_INTENSITY12, "I", AS(kL)},
    {GL_INTENSITY16, "I", AS(kL)},
    {GL_RGB, "RGB", AS(kRgb)},
    {GL_R3_G3_B2, "RGB", AS(kRgb)},
    {GL_RGB4, "RGB", AS(kRgb)},
    {GL_RGB5, "RGB", AS(kRgb)},
    {GL_RGB8, "RGB", AS(kRgb)},
    {GL_RGB10, "RGB", AS(kRgb)},
    {GL_RGB12, "RGB", AS(kRgb)},
    {GL_RGB16, "RGB", AS(kRgb)},
    {GL_RGBA, "RGBA", AS(kRgba)},
    {GL_RGBA2, "RGBA", AS(kRgba)},
    {GL_RGBA4, "RGBA", AS(kRgba)},
    {GL_RGB5_A1, "RGBA", AS(kRgba)},
    {GL_RGBA8, "RGBA", AS(kRgba)},
    {GL_RGB10_A2, "RGBA", AS(kRgba)},
    {GL_RGBA12, "RGBA", AS(kRgba)},
    {GL_RGBA16, "RGBA", AS(kRgba)},
};
#undef AS

Texels counting_texels(size_t count) {
  Texels out(count * 4);
  for (size_t i = 0; i < out.size(); ++i) out[i] = uint8_t(i * 37 + 11 * (i >> 8) + 1);
  return out;
}

class TextureImageTest : public PixelTest {
 protected:
  void image(GLint level, GLint internal_format, GLsizei width, GLsizei height, GLint border,
             const void* pixels, GLenum format = GL_RGBA, GLenum type = GL_UNSIGNED_BYTE,
             GLenum target = GL_TEXTURE_2D) {
    op::tex_image_2d(gl(), target, level, internal_format, width, height, border, format, type, pixels);
  }
  void sub_image(GLint x, GLint y, GLsizei width, GLsizei height, const void* pixels, GLenum format = GL_RGBA,
                 GLenum type = GL_UNSIGNED_BYTE, GLint level = 0, GLenum target = GL_TEXTURE_2D) {
    op::tex_sub_image_2d(gl(), target, level, x, y, width, height, format, type, pixels);
  }
  Texels read(GLsizei width, GLsizei height, GLint level = 0) {
    Texels out(size_t(width * height) * 4, 0xCD);
    op::get_tex_image(gl(), GL_TEXTURE_2D, level, GL_RGBA, GL_UNSIGNED_BYTE, out.data());
    return out;
  }
  GLint query(GLenum pname, GLint level = 0, GLenum target = GL_TEXTURE_2D) {
    GLint value = -77;
    op::get_tex_level_parameteriv(gl(), target, level, pname, &value);
    return value;
  }
};

TEST_F(TextureImageTest, KeepsTheComponentsOfEveryInternalFormat) {
  const Texels source = counting_texels(32);
  constexpr GLenum kSizes[] = {GL_TEXTURE_RED_SIZE,   GL_TEXTURE_GREEN_SIZE,     GL_TEXTURE_BLUE_SIZE,
                               GL_TEXTURE_ALPHA_SIZE, GL_TEXTURE_LUMINANCE_SIZE, GL_TEXTURE_INTENSITY_SIZE};
  for (const InternalFormat& format : kInternalFormats) {
    image(0, format.name, 8, 4, 0, source.data());
    EXPECT_GL(GL_NO_ERROR) << std::hex << format.name;
    EXPECT_EQ(query(GL_TEXTURE_DEPTH_SIZE), 0);  // names of later versions, of components that no image has
    EXPECT_EQ(query(GL_TEXTURE_STENCIL_SIZE), 0);
    EXPECT_EQ(query(GL_TEXTURE_INTERNAL_FORMAT), format.name);
    for (size_t i = 0; i < 6; ++i) {
      const bool kept = std::strchr(format.kept, "RGBALI"[i]) != nullptr;
      EXPECT_EQ(query(kSizes[i]), kept ? 8 : 0) << std::hex << format.name << " component " << i;
    }
    const Texels out = read(8, 4);
    for (size_t i = 0; i < 32; ++i) {
      for (size_t c = 0; c < 4; ++c) {
        const int from = format.from[c];
        const int expected = from == kZero ? 0 : from == kOne ? 255 : source[i * 4 + size_t(from)];
        ASSERT_EQ(int(out[i * 4 + c]), expected) << std::hex << format.name << " component " << c;
      }
    }
  }
}

// What the sampler gets: luminance and intensity spread out (raster::Texture::define_level).
TEST_F(TextureImageTest, StoresTheFormTheRasteriserWants) {
  const uint8_t texel[4] = {10, 20, 30, 40};
  const std::pair<GLint, std::array<uint8_t, 4>> kStored[] = {{GL_ALPHA, {0, 0, 0, 40}},
                                                              {GL_LUMINANCE, {10, 10, 10, 255}},
                                                              {GL_LUMINANCE_ALPHA, {10, 10, 10, 40}},
                                                              {GL_INTENSITY, {10, 10, 10, 10}},
                                                              {GL_RGB, {10, 20, 30, 255}},
                                                              {GL_RGBA, {10, 20, 30, 40}}};
  for (const auto& [format, expected] : kStored) {
    image(0, format, 1, 1, 0, texel);
    std::array<uint8_t, 4> stored{};
    gl().texture.bound_2d->storage.read_level(0, stored.data(), 4);
    EXPECT_EQ(stored, expected) << std::hex << format;
  }
}

TEST_F(TextureImageTest, ConvertsEveryClientFormatAndType) {
  using namespace pixel_model;
  constexpr size_t kTexels = 8 * 8;
  for (const FormatRow& format : kFormats) {
    for (const TypeRow& type : kTypes) {
      const size_t size = size_t(type.bits) / 8, n = format.components.size();
      Bytes source(kTexels * n * size);
      for (size_t i = 0; i < source.size(); ++i) source[i] = std::byte((i * 89 + i / 7) & 0xFF);
      image(0, GL_RGBA, 8, 8, 0, source.data(), format.format, type.type);
      EXPECT_GL(GL_NO_ERROR);
      const Texels out = read(8, 8);
      const size_t row_bytes = (8 * n * size + 3) / 4 * 4;
      for (size_t i = 0; i < kTexels; ++i) {
        std::vector<Real> values;
        for (size_t c = 0; c < n; ++c) {
          const size_t at = i / 8 * row_bytes + (i % 8 * n + c) * size;
          values.push_back(component_value(type, read_element(&source[at], size, false)));
        }
        const Rgba expected = expand(format.components, values);
        for (size_t c = 0; c < 4; ++c) {
          ASSERT_EQ(int(out[i * 4 + c]), int(round_half_up(clamp01(expected[c]) * 255)))
              << format.components << " type " << std::hex << type.type << " texel " << i;
        }
      }
    }
  }
}

TEST_F(TextureImageTest, UnpackStoreSaysWhereTexelsAre) {
  // A 4x2 image at (3, 2) of a picture 9 pixels wide, rows of three bytes a pixel rounded up to 8.
  constexpr size_t kRowBytes = 32;
  Texels picture(kRowBytes * 4);
  for (size_t i = 0; i < picture.size(); ++i) picture[i] = uint8_t(i);
  op::pixel_storei(gl(), GL_UNPACK_ROW_LENGTH, 9);
  op::pixel_storei(gl(), GL_UNPACK_SKIP_PIXELS, 3);
  op::pixel_storei(gl(), GL_UNPACK_SKIP_ROWS, 2);
  op::pixel_storei(gl(), GL_UNPACK_ALIGNMENT, 8);
  image(0, GL_RGB, 4, 2, 0, picture.data(), GL_RGB);
  const Texels out = read(4, 2);
  for (size_t y = 0; y < 2; ++y) {
    for (size_t x = 0; x < 4; ++x) {
      for (size_t c = 0; c < 3; ++c)
        EXPECT_EQ(out[(y * 4 + x) * 4 + c], (2 + y) * kRowBytes + (3 + x) * 3 + c);
    }
  }
}

TEST_F(TextureImageTest, PackStoreSaysWhereTexelsGo) {
  const Texels source = counting_texels(8);
  image(0, GL_RGBA, 4, 2, 0, source.data());
  op::pixel_storei(gl(), GL_PACK_ROW_LENGTH, 7);
  op::pixel_storei(gl(), GL_PACK_SKIP_PIXELS, 2);
  op::pixel_storei(gl(), GL_PACK_SKIP_ROWS, 1);
  op::pixel_storei(gl(), GL_PACK_ALIGNMENT, 4);
  constexpr size_t kRowBytes = 16;  // 7 * 2, rounded up
  Texels out(kRowBytes * 4, 0xCD), expected = out;
  op::get_tex_image(gl(), GL_TEXTURE_2D, 0, GL_LUMINANCE_ALPHA, GL_UNSIGNED_BYTE, out.data());
  for (size_t y = 0; y < 2; ++y) {
    for (size_t x = 0; x < 4; ++x) {
      const uint8_t* texel = &source[(y * 4 + x) * 4];
      expected[(1 + y) * kRowBytes + (2 + x) * 2] = texel[0];  // L is R alone: no sum, as glReadPixels has it
      expected[(1 + y) * kRowBytes + (2 + x) * 2 + 1] = texel[3];
    }
  }
  EXPECT_EQ(out, expected);
}

TEST_F(TextureImageTest, BordersArePartOfTheImage) {
  const Texels source = counting_texels(6 * 4);
  image(0, GL_RGBA, 6, 4, 1, source.data());
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_EQ(query(GL_TEXTURE_WIDTH), 6);
  EXPECT_EQ(query(GL_TEXTURE_HEIGHT), 4);
  EXPECT_EQ(query(GL_TEXTURE_BORDER), 1);
  EXPECT_EQ(read(6, 4), source);

  Texels expected = source;
  const Texels patch(2 * 2 * 4, 0x5A);
  sub_image(-1, -1, 2, 2, patch.data());
  sub_image(3, 1, 2, 2, patch.data());
  EXPECT_GL(GL_NO_ERROR);
  for (size_t y = 0; y < 4; ++y) {
    for (size_t x = 0; x < 6; ++x) {
      const bool patched = (x < 2 && y < 2) || (x >= 4 && y >= 2);
      if (patched) std::memset(&expected[(y * 6 + x) * 4], 0x5A, 4);
    }
  }
  EXPECT_EQ(read(6, 4), expected);
  sub_image(-2, 0, 2, 2, patch.data());
  EXPECT_GL(GL_INVALID_VALUE);
  sub_image(4, 0, 2, 2, patch.data());
  EXPECT_GL(GL_INVALID_VALUE);
  EXPECT_EQ(read(6, 4), expected);
}

TEST_F(TextureImageTest, SubImagesOfEveryBaseFormatChangeOnlyTheirTexels) {
  const Texels source = counting_texels(64), patch = counting_texels(200);
  for (GLint format : {GL_ALPHA, GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_INTENSITY, GL_RGB, GL_RGBA}) {
    image(0, format, 8, 8, 0, patch.data() + 400);
    const Texels whole = read(8, 8);  // the patch's texels as this format keeps them
    image(0, format, 8, 8, 0, source.data());
    Texels expected = read(8, 8);
    op::pixel_storei(gl(), GL_UNPACK_ROW_LENGTH, 8);
    sub_image(5, 2, 3, 4, patch.data() + 400);
    op::pixel_storei(gl(), GL_UNPACK_ROW_LENGTH, 0);
    EXPECT_GL(GL_NO_ERROR);
    for (size_t y = 0; y < 4; ++y) std::memcpy(&expected[((2 + y) * 8 + 5) * 4], &whole[y * 8 * 4], 3 * 4);
    EXPECT_EQ(read(8, 8), expected) << std::hex << format;
  }
}

// A refused call says why and leaves the image, its queries and its view alone.
TEST_F(TextureImageTest, RefusedImagesChangeNothing) {
  const Texels source = counting_texels(16);
  image(0, GL_RGB, 4, 4, 0, source.data());
  const Texels before = read(4, 4);
  struct Call {
    GLenum error;
    GLenum target;
    GLint level, internal_format;
    GLsizei width, height;
    GLint border;
    GLenum format, type;
  };
  constexpr GLenum k2D = GL_TEXTURE_2D, kByte = GL_UNSIGNED_BYTE;
  const Call calls[] = {
      {GL_INVALID_ENUM, GL_TEXTURE_1D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, kByte},
      {GL_INVALID_ENUM, GL_PROXY_TEXTURE_1D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, kByte},
      {GL_INVALID_VALUE, k2D, -1, GL_RGBA, 2, 2, 0, GL_RGBA, kByte},
      {GL_INVALID_VALUE, k2D, raster::kMaxTextureLevels, GL_RGBA, 1, 1, 0, GL_RGBA, kByte},
      {GL_INVALID_VALUE, k2D, 0, 0, 2, 2, 0, GL_RGBA, kByte},
      {GL_INVALID_VALUE, k2D, 0, 5, 2, 2, 0, GL_RGBA, kByte},
      {GL_INVALID_VALUE, k2D, 0, GL_BGRA, 2, 2, 0, GL_RGBA, kByte},
      {GL_INVALID_VALUE, k2D, 0, GL_COLOR_INDEX, 2, 2, 0, GL_RGBA, kByte},
      {GL_INVALID_VALUE, k2D, 0, GL_RGBA, -2, 2, 0, GL_RGBA, kByte},
      {GL_INVALID_VALUE, k2D, 0, GL_RGBA, 2, -2, 0, GL_RGBA, kByte},
      {GL_INVALID_VALUE, k2D, 0, GL_RGBA, 3, 2, 0, GL_RGBA, kByte},
      {GL_INVALID_VALUE, k2D, 0, GL_RGBA, 2, 6, 0, GL_RGBA, kByte},
      {GL_INVALID_VALUE, k2D, 0, GL_RGBA, 5, 4, 1, GL_RGBA, kByte},
      {GL_INVALID_VALUE, k2D, 0, GL_RGBA, 2, 2, 1, GL_RGBA, kByte},
      {GL_INVALID_VALUE, k2D, 0, GL_RGBA, 0, 0, 1, GL_RGBA, kByte},
      {GL_INVALID_VALUE, k2D, 0, GL_RGBA, 6, 6, 2, GL_RGBA, kByte},
      {GL_INVALID_VALUE, k2D, 0, GL_RGBA, 2, 2, -1, GL_RGBA, kByte},
      {GL_INVALID_VALUE, k2D, 0, GL_RGBA, 1 << 20, 1, 0, GL_RGBA, kByte},
      {GL_INVALID_VALUE, k2D, 1, GL_RGBA, raster::kMaxTextureSize, 1, 0, GL_RGBA, kByte},
      {GL_INVALID_ENUM, k2D, 0, GL_RGBA, 2, 2, 0, GL_DEPTH_COMPONENT, kByte},
      {GL_INVALID_ENUM, k2D, 0, GL_RGBA, 2, 2, 0, GL_STENCIL_INDEX, kByte},
      {GL_INVALID_ENUM, k2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA8, kByte},
      {GL_INVALID_ENUM, k2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_BITMAP},
      {GL_INVALID_ENUM, k2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_DOUBLE},
      {GL_INVALID_OPERATION, k2D, 0, GL_RGBA, 2, 2, 0, GL_RGB, GL_UNSIGNED_INT_8_8_8_8},
      {GL_INVALID_OPERATION, k2D, 0, GL_RGBA, 2, 2, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT_8_8_8_8},
  };
  for (const Call& call : calls) {
    image(call.level, call.internal_format, call.width, call.height, call.border, source.data(), call.format,
          call.type, call.target);
    EXPECT_GL(call.error) << "call " << &call - calls;
    EXPECT_EQ(read(4, 4), before) << "call " << &call - calls;
    EXPECT_EQ(query(GL_TEXTURE_INTERNAL_FORMAT), GL_RGB);
    EXPECT_EQ(query(GL_TEXTURE_WIDTH), 4);
  }
}

TEST_F(TextureImageTest, RefusedSubImagesChangeNothing) {
  const Texels source = counting_texels(16), patch(64, 0xEE);
  sub_image(0, 0, 1, 1, patch.data());
  EXPECT_GL(GL_INVALID_OPERATION);  // no image yet
  image(0, GL_RGBA, 4, 4, 0, source.data());
  struct Call {
    GLenum error;
    GLint x, y;
    GLsizei width, height;
    GLenum format = GL_RGBA, type = GL_UNSIGNED_BYTE;
    GLint level = 0;
    GLenum target = GL_TEXTURE_2D;
  };
  const Call calls[] = {
      {GL_INVALID_VALUE, -1, 0, 2, 2},
      {GL_INVALID_VALUE, 0, -1, 2, 2},
      {GL_INVALID_VALUE, 3, 0, 2, 2},
      {GL_INVALID_VALUE, 0, 3, 2, 2},
      {GL_INVALID_VALUE, 0, 0, -1, 2},
      {GL_INVALID_VALUE, 0, 0, 2, -1},
      {GL_INVALID_VALUE, 0x7FFFFFFF, 0, 0x7FFFFFFF, 1},
      {GL_INVALID_VALUE, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, -1},
      {GL_INVALID_VALUE, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, raster::kMaxTextureLevels},
      {GL_INVALID_OPERATION, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, 1},
      {GL_INVALID_ENUM, 0, 0, 1, 1, GL_DEPTH_COMPONENT},
      {GL_INVALID_ENUM, 0, 0, 1, 1, GL_RGBA, GL_BITMAP},
      {GL_INVALID_OPERATION, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_SHORT_5_6_5},
      {GL_INVALID_ENUM, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, 0, GL_PROXY_TEXTURE_2D},
  };
  for (const Call& call : calls) {
    sub_image(call.x, call.y, call.width, call.height, patch.data(), call.format, call.type, call.level,
              call.target);
    EXPECT_GL(call.error) << "call " << &call - calls;
  }
  sub_image(4, 4, 0, 0, patch.data());  // nothing, at the very edge
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_EQ(read(4, 4), source);
}

TEST_F(TextureImageTest, AZeroSideIsTheNullImage) {
  const Texels source = counting_texels(16);
  image(0, GL_RGB, 4, 4, 0, source.data());
  image(0, GL_RGB, 0, 4, 0, source.data());
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_EQ(query(GL_TEXTURE_WIDTH), 0);
  EXPECT_EQ(read(4, 4), Texels(64, 0xCD));  // untouched
  gl().texture.enabled_2d = true;
  EXPECT_EQ(current_texture_view(gl()), nullptr);
}

TEST_F(TextureImageTest, NullPixelsDefineTheSizeOnly) {
  image(0, GL_RGBA, 16, 8, 0, nullptr);
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_EQ(query(GL_TEXTURE_WIDTH), 16);
  const Texels patch = counting_texels(16 * 8);
  sub_image(0, 0, 16, 8, patch.data());
  EXPECT_EQ(read(16, 8), patch);
}

// The largest image there is costs no more memory than what is written to it.
TEST_F(TextureImageTest, TheLargestImage) {
  const GLsizei max = raster::kMaxTextureSize;
  for (GLint border : {0, 1}) {
    image(0, GL_RGBA16, max + 2 * border, max + 2 * border, border, nullptr);
    EXPECT_GL(GL_NO_ERROR);
    EXPECT_EQ(query(GL_TEXTURE_WIDTH), max + 2 * border);
    const Texels patch = counting_texels(4);
    sub_image(max - 2, max - 2, 2, 2, patch.data());
    EXPECT_GL(GL_NO_ERROR);
    const GLint nearest = GL_NEAREST;
    op::tex_parameteriv(gl(), GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, &nearest);
    gl().texture.enabled_2d = true;
    const auto view = current_texture_view(gl());
    ASSERT_NE(view, nullptr);
    const raster::TextureLevel& level = *view->levels[0];
    uint8_t last[4];
    std::memcpy(last, level.base + size_t(max) * size_t(level.pitch) + size_t(max), 4);
    EXPECT_EQ(Texels(last, last + 4), Texels(patch.end() - 4, patch.end()));
    EXPECT_EQ(level.texel(max / 2, max / 2), 0u);
  }
}

TEST_F(TextureImageTest, TransferActsOnTheWayInOnly) {
  op::pixel_transfer(gl(), GL_RED_SCALE, 0.5);
  op::pixel_transfer(gl(), GL_ALPHA_BIAS, 1);
  const Texels source = {100, 20, 30, 40, 7, 8, 9, 10};
  image(0, GL_RGBA, 2, 1, 0, source.data());
  EXPECT_EQ(read(2, 1), (Texels{50, 20, 30, 255, 4, 8, 9, 255}));
  sub_image(1, 0, 1, 1, source.data());
  EXPECT_EQ(read(2, 1), (Texels{50, 20, 30, 255, 50, 20, 30, 255}));
}

TEST_F(TextureImageTest, ColourIndicesGoThroughTheMaps) {
  const GLfloat red[] = {0, 0.2f, 0.4f, 0.6f}, green[] = {1, 0};
  op::pixel_mapfv(gl(), GL_PIXEL_MAP_I_TO_R, 4, red);
  op::pixel_mapfv(gl(), GL_PIXEL_MAP_I_TO_G, 2, green);
  const uint8_t indices[] = {3, 0, 1, 6};
  image(0, GL_RGBA, 4, 1, 0, indices, GL_COLOR_INDEX);
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_EQ(read(4, 1), (Texels{153, 0, 0, 0, 0, 255, 0, 0, 51, 0, 0, 0, 102, 255, 0, 0}));
  const uint8_t bits[] = {0x50};  // 0 1 0 1
  image(0, GL_RGB, 4, 1, 0, bits, GL_COLOR_INDEX, GL_BITMAP);
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_EQ(read(4, 1), (Texels{0, 255, 0, 255, 51, 0, 0, 255, 0, 255, 0, 255, 51, 0, 0, 255}));
}

TEST_F(TextureImageTest, ProxiesAnswerWithoutErrors) {
  const auto ask = [&](GLint level, GLsizei width, GLsizei height, GLint border) {
    image(level, GL_RGB5, width, height, border, nullptr, GL_RGBA, GL_UNSIGNED_BYTE, GL_PROXY_TEXTURE_2D);
    EXPECT_GL(GL_NO_ERROR);
  };
  const GLsizei max = raster::kMaxTextureSize;
  struct Case {
    GLint level;
    GLsizei width, height;
    GLint border;
    bool fits;
  };
  for (const Case& c :
       {Case{0, 64, 32, 0, true}, Case{0, max, max, 0, true}, Case{0, max + 2, max + 2, 1, true},
        Case{0, 2 * max, 1, 0, false}, Case{1, max, 1, 0, false}, Case{1, max / 2, 1, 0, true},
        Case{0, 48, 32, 0, false}, Case{0, 64, 32, 1, false}, Case{14, 1, 1, 0, true}}) {
    ask(c.level, c.width, c.height, c.border);
    EXPECT_EQ(query(GL_TEXTURE_WIDTH, c.level, GL_PROXY_TEXTURE_2D), c.fits ? c.width : 0);
    EXPECT_EQ(query(GL_TEXTURE_HEIGHT, c.level, GL_PROXY_TEXTURE_2D), c.fits ? c.height : 0);
    EXPECT_EQ(query(GL_TEXTURE_BORDER, c.level, GL_PROXY_TEXTURE_2D), c.fits ? c.border : 0);
    EXPECT_EQ(query(GL_TEXTURE_INTERNAL_FORMAT, c.level, GL_PROXY_TEXTURE_2D), c.fits ? GL_RGB5 : 0);
    EXPECT_EQ(query(GL_TEXTURE_RED_SIZE, c.level, GL_PROXY_TEXTURE_2D), c.fits ? 8 : 0);
  }
  EXPECT_EQ(query(GL_TEXTURE_WIDTH), 0);  // the bound texture never heard of it
  image(-1, GL_RGB, 1, 1, 0, nullptr, GL_RGBA, GL_UNSIGNED_BYTE, GL_PROXY_TEXTURE_2D);
  EXPECT_GL(GL_INVALID_VALUE);
  image(0, GL_RGB, 1, 1, 0, nullptr, GL_DEPTH_COMPONENT, GL_UNSIGNED_BYTE, GL_PROXY_TEXTURE_2D);
  EXPECT_GL(GL_INVALID_ENUM);
}

TEST_F(TextureImageTest, QueriesStartAndFailAsTheSpecSays) {
  EXPECT_EQ(query(GL_TEXTURE_INTERNAL_FORMAT), 1);
  for (GLenum pname : {GLenum{GL_TEXTURE_WIDTH}, GLenum{GL_TEXTURE_HEIGHT}, GLenum{GL_TEXTURE_BORDER},
                       GLenum{GL_TEXTURE_LUMINANCE_SIZE}}) {
    EXPECT_EQ(query(pname), 0);
  }
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_EQ(query(GL_TEXTURE_WIDTH, -1), -77);
  EXPECT_GL(GL_INVALID_VALUE);
  EXPECT_EQ(query(GL_TEXTURE_WIDTH, raster::kMaxTextureLevels), -77);
  EXPECT_GL(GL_INVALID_VALUE);
  EXPECT_EQ(query(GL_TEXTURE_WIDTH, 0, GL_TEXTURE_ENV), -77);
  EXPECT_GL(GL_INVALID_ENUM);
  EXPECT_EQ(query(GL_TEXTURE_MIN_FILTER), -77);
  EXPECT_GL(GL_INVALID_ENUM);
  GLfloat value = 0;
  image(0, GL_RGB, 4, 2, 0, nullptr);
  op::get_tex_level_parameterfv(gl(), GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &value);
  EXPECT_EQ(value, 4.0f);
}

TEST_F(TextureImageTest, GetTexImageRefuses) {
  image(0, GL_RGBA, 1, 1, 0, nullptr);
  uint8_t out[16];
  std::memset(out, 0xCD, sizeof out);
  const auto get = [&](GLenum target, GLint level, GLenum format, GLenum type) {
    op::get_tex_image(gl(), target, level, format, type, out);
  };
  get(GL_PROXY_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE);
  EXPECT_GL(GL_INVALID_ENUM);
  get(GL_TEXTURE_2D, -1, GL_RGBA, GL_UNSIGNED_BYTE);
  EXPECT_GL(GL_INVALID_VALUE);
  get(GL_TEXTURE_2D, 0, GL_COLOR_INDEX, GL_UNSIGNED_BYTE);
  EXPECT_GL(GL_INVALID_ENUM);
  get(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_BYTE);
  EXPECT_GL(GL_INVALID_ENUM);
  get(GL_TEXTURE_2D, 0, GL_RGBA, GL_BITMAP);
  EXPECT_GL(GL_INVALID_ENUM);
  get(GL_TEXTURE_2D, 0, GL_RGB, GL_UNSIGNED_INT_8_8_8_8);
  EXPECT_GL(GL_INVALID_OPERATION);
  get(GL_TEXTURE_2D, 3, GL_RGBA, GL_UNSIGNED_BYTE);  // a level without image
  EXPECT_GL(GL_NO_ERROR);
  for (uint8_t byte : out) EXPECT_EQ(byte, 0xCD);
}

}  // namespace
}  // namespace halfspace::state
