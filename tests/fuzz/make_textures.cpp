// Texture images, parameters and environment.
#include <algorithm>
#include <cmath>

#include "maker.h"

namespace halfspace::fuzz {
namespace {

struct Layout {
  GLenum format;
  int components;
};

// The picture a texture shows. Smooth where it is filtered: weights have few bits in some renderers, and
// which level is taken is open to nearly one (3.8.8), so levels differ by little from each other, and are
// nearly plain. Noise where texels are picked.
class Image {
 public:
  Image(Maker& m, int components, bool levels) : maker_(m) {
    for (int c = 0; c < components; ++c)
      waves_.push_back({m.random.below(100), levels ? 12 : m.random.below(130), m.random.chance(50)});
  }

  std::vector<uint8_t> at(int width, int height, int level) const {
    std::vector<uint8_t> image;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        for (const Wave& wave : waves_)
          image.push_back(texel(wave, (x + 0.5) / width, (y + 0.5) / height, level));
      }
    }
    return image;
  }

 private:
  struct Wave {
    int base, height;
    bool upwards;
  };

  uint8_t texel(const Wave& wave, double s, double t, int level) const {
    if (maker_.exact) return static_cast<uint8_t>(maker_.random.bits());
    const double rise = 0.5 - 0.5 * std::cos(6.283185307 * (wave.upwards ? t : s));
    return static_cast<uint8_t>(wave.base + wave.height * rise + 4 * level);
  }

  Maker& maker_;
  std::vector<Wave> waves_;
};

void parameter(Maker& m, double target, double name, double value) {
  m.call(Command::glTexParameteri, {target, name, value});
}

void add_wrap(Maker& m, double target) {
  parameter(m, target, GL_TEXTURE_WRAP_S, m.random.pick({GL_CLAMP, GL_REPEAT}));
  parameter(m, target, GL_TEXTURE_WRAP_T, m.random.pick({GL_CLAMP, GL_REPEAT}));
  if (m.random.chance(40)) m.call(Command::glTexParameterfv, {target, GL_TEXTURE_BORDER_COLOR, 0}, m.color());
}

void upload(Maker& m, double target, int width, int height, bool levels) {
  const Layout layout =
      m.random.pick({Layout{GL_RGB, 3}, Layout{GL_RGBA, 4}, Layout{GL_LUMINANCE, 1},
                     Layout{GL_LUMINANCE_ALPHA, 2}, Layout{GL_ALPHA, 1}, Layout{GL_RED, 1}});
  const double internal_format =
      m.decal ? m.random.pick({GL_RGB8, GL_RGBA8, GL_RGB, GL_RGBA, 3, 4})
              : m.random.pick({GL_RGB8, GL_RGBA8, GL_RGB, GL_RGBA, GL_LUMINANCE8, GL_LUMINANCE8_ALPHA8,
                               GL_ALPHA8, GL_INTENSITY8, 3, 4, 1, 2});
  m.call(Command::glPixelStorei, {GL_UNPACK_ALIGNMENT, 1});
  const Image picture(m, layout.components, levels);
  for (int level = 0;; ++level) {
    const std::vector<uint8_t> image = picture.at(width, height, level);
    if (target == GL_TEXTURE_1D) {
      m.call(Command::glTexImage1D,
             {target, double(level), internal_format, double(width), 0, double(layout.format),
              GL_UNSIGNED_BYTE, 0},
             image);
    } else {
      m.call(Command::glTexImage2D,
             {target, double(level), internal_format, double(width), double(height), 0, double(layout.format),
              GL_UNSIGNED_BYTE, 0},
             image);
    }
    if (!levels || (width == 1 && height == 1)) break;
    width = std::max(width / 2, 1);
    height = std::max(height / 2, 1);
  }
}

void add_texture(Maker& m, GLenum target) {
  const double name = 1 + m.random.below(3) + (target == GL_TEXTURE_1D ? 10 : 0);
  m.call(Command::glBindTexture, {double(target), name});
  const bool mipmaps = !m.exact && m.random.chance(40);
  // CLAMP with NEAREST is exact up to the border; with LINEAR the border is half the colour.
  const double nearest = GL_NEAREST;
  // Where magnification begins is open a little, so that both filters are the same but for mipmaps, which are
  // nearly plain.
  const double filter = m.exact ? nearest : double(m.random.pick({GL_NEAREST, GL_LINEAR}));
  parameter(m, target, GL_TEXTURE_MAG_FILTER, filter);
  parameter(m, target, GL_TEXTURE_MIN_FILTER,
            mipmaps ? double(m.random.pick({GL_NEAREST_MIPMAP_NEAREST, GL_LINEAR_MIPMAP_NEAREST,
                                            GL_NEAREST_MIPMAP_LINEAR, GL_LINEAR_MIPMAP_LINEAR}))
                    : filter);
  // Clamped, the border's share of a texel grows with the level.
  if (mipmaps) {
    parameter(m, target, GL_TEXTURE_WRAP_S, GL_REPEAT);
    parameter(m, target, GL_TEXTURE_WRAP_T, GL_REPEAT);
  } else {
    add_wrap(m, target);
  }
  const int width = 1 << m.random.between(2, 5),
            height = target == GL_TEXTURE_1D ? 1 : 1 << m.random.between(2, 5);
  upload(m, target, width, height, mipmaps);
  m.set_enabled(target, !m.polygon_points && m.random.chance(85));
}

void add_texture_1d(Maker& m) { add_texture(m, GL_TEXTURE_1D); }
void add_texture_2d(Maker& m) { add_texture(m, GL_TEXTURE_2D); }

void add_texture_environment(Maker& m) {
  const double mode =
      m.exact ? double(GL_REPLACE)
              : double(m.random.pick({GL_MODULATE, m.decal ? GL_DECAL : GL_MODULATE, GL_BLEND, GL_REPLACE}));
  m.call(Command::glTexEnvi, {GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, mode});
  if (m.random.chance(50)) m.call(Command::glTexEnvfv, {GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, 0}, m.color());
}

void add_texture_matrix(Maker& m) {
  m.call(Command::glMatrixMode, {GL_TEXTURE});
  if (m.random.chance(30)) m.call(Command::glLoadIdentity);
  m.call(Command::glTranslatef, {m.random.real(-1, 1), m.random.real(-1, 1), 0});
  m.call(Command::glScalef, {m.random.real(0.5, 2), m.random.real(0.5, 2), 1});
  m.call(Command::glMatrixMode, {GL_MODELVIEW});
}

void add_sub_image(Maker& m) {
  if (m.exact) return;
  const std::vector<uint8_t> image = Image(m, 4, true).at(2, 2, 0);
  // May be refused: there need not be an image.
  m.call(Command::glTexSubImage2D,
         {GL_TEXTURE_2D, 0, double(m.random.below(3)), double(m.random.below(3)), 2, 2, GL_RGBA,
          GL_UNSIGNED_BYTE, 0},
         image);
}

// Mesa's copies come out dark when they go through pixel transfer, even if only alpha changes.
void add_copy_image(Maker& m) {
  if (m.transfers) return;
  m.call(Command::glBindTexture, {GL_TEXTURE_2D, 5});
  parameter(m, GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  parameter(m, GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  m.call(Command::glCopyTexImage2D,
         {GL_TEXTURE_2D, 0,
          double(m.decal ? m.random.pick({GL_RGB8, GL_RGBA8})
                         : m.random.pick({GL_RGB8, GL_RGBA8, GL_LUMINANCE8, GL_ALPHA8})),
          double(m.random.below(60)), double(m.random.below(50)), 16, 16, 0});
  m.set_enabled(GL_TEXTURE_2D, !m.polygon_points);
}

}  // namespace

const std::vector<Feature>& texture_features() {
  static const std::vector<Feature> kFeatures = {
      {"texture", add_texture_2d, 3},  {"texture", add_texture_environment, 2},
      {"texture", add_texture_matrix}, {.group = "texture", .add = add_sub_image, .exact = false},
      {"texture_1d", add_texture_1d},  {"copy_texture", add_copy_image},
  };
  return kFeatures;
}

}  // namespace halfspace::fuzz
