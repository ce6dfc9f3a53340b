#include "state/texture_format.h"

namespace halfspace::state {

using raster::BaseFormat;

std::optional<BaseFormat> base_format_of(GLint internal_format) {
  switch (internal_format) {
    case GL_ALPHA:
    case GL_ALPHA4:
    case GL_ALPHA8:
    case GL_ALPHA12:
    case GL_ALPHA16:
      return BaseFormat::alpha;
    case 1:
    case GL_LUMINANCE:
    case GL_LUMINANCE4:
    case GL_LUMINANCE8:
    case GL_LUMINANCE12:
    case GL_LUMINANCE16:
      return BaseFormat::luminance;
    case 2:
    case GL_LUMINANCE_ALPHA:
    case GL_LUMINANCE4_ALPHA4:
    case GL_LUMINANCE6_ALPHA2:
    case GL_LUMINANCE8_ALPHA8:
    case GL_LUMINANCE12_ALPHA4:
    case GL_LUMINANCE12_ALPHA12:
    case GL_LUMINANCE16_ALPHA16:
      return BaseFormat::luminance_alpha;
    case GL_INTENSITY:
    case GL_INTENSITY4:
    case GL_INTENSITY8:
    case GL_INTENSITY12:
    case GL_INTENSITY16:
      return BaseFormat::intensity;
    case 3:
    case GL_RGB:
    case GL_R3_G3_B2:
    case GL_RGB4:
    case GL_RGB5:
    case GL_RGB8:
    case GL_RGB10:
    case GL_RGB12:
    case GL_RGB16:
      return BaseFormat::rgb;
    case 4:
    case GL_RGBA:
    case GL_RGBA2:
    case GL_RGBA4:
    case GL_RGB5_A1:
    case GL_RGBA8:
    case GL_RGB10_A2:
    case GL_RGBA12:
    case GL_RGBA16:
      return BaseFormat::rgba;
    default:
      return std::nullopt;
  }
}

GLint canonical_format(GLint internal_format) {
  switch (internal_format) {
    case 1:
      return GL_LUMINANCE;
    case 2:
      return GL_LUMINANCE_ALPHA;
    case 3:
      return GL_RGB;
    case 4:
      return GL_RGBA;
    default:
      return internal_format;
  }
}

std::array<uint8_t, 6> component_bits(BaseFormat base) {
  switch (base) {
    case BaseFormat::alpha:
      return {0, 0, 0, 8, 0, 0};
    case BaseFormat::luminance:
      return {0, 0, 0, 0, 8, 0};
    case BaseFormat::luminance_alpha:
      return {0, 0, 0, 8, 8, 0};
    case BaseFormat::intensity:
      return {0, 0, 0, 0, 0, 8};
    case BaseFormat::rgb:
      return {8, 8, 8, 0, 0, 0};
    case BaseFormat::rgba:
      return {8, 8, 8, 8, 0, 0};
  }
  return {};
}

namespace {

template <class Change>
void for_each_texel(uint8_t* rgba, size_t count, Change&& change) {
  for (uint8_t* end = rgba + count * 4; rgba != end; rgba += 4) change(rgba);
}

}  // namespace

void reduce_to_base(BaseFormat base, uint8_t* rgba, size_t count) {
  switch (base) {
    case BaseFormat::alpha:
      return for_each_texel(rgba, count, [](uint8_t* t) { t[0] = t[1] = t[2] = 0; });
    case BaseFormat::luminance:
      return for_each_texel(rgba, count, [](uint8_t* t) { t[1] = t[2] = t[0], t[3] = 255; });
    case BaseFormat::luminance_alpha:
      return for_each_texel(rgba, count, [](uint8_t* t) { t[1] = t[2] = t[0]; });
    case BaseFormat::intensity:
      return for_each_texel(rgba, count, [](uint8_t* t) { t[1] = t[2] = t[3] = t[0]; });
    case BaseFormat::rgb:
      return for_each_texel(rgba, count, [](uint8_t* t) { t[3] = 255; });
    case BaseFormat::rgba:
      return;
  }
}

void expand_from_base(BaseFormat base, uint8_t* rgba, size_t count) {
  switch (base) {
    case BaseFormat::luminance:
    case BaseFormat::intensity:
      return for_each_texel(rgba, count, [](uint8_t* t) { t[1] = t[2] = 0, t[3] = 255; });
    case BaseFormat::luminance_alpha:
      return for_each_texel(rgba, count, [](uint8_t* t) { t[1] = t[2] = 0; });
    case BaseFormat::rgb:
      return for_each_texel(rgba, count, [](uint8_t* t) { t[3] = 255; });
    case BaseFormat::alpha:
    case BaseFormat::rgba:
      return;
  }
}

}  // namespace halfspace::state
