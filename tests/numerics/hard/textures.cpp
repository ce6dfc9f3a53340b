// Texture coordinates, levels and borders where they are hardest to get right.
#include <cmath>

#include "cases.h"

namespace halfspace::hard {

void texcoord_offsets(Stage& stage) {
  bind_texture(noise(61, 8, 8), 8, 8, GL_LINEAR, GL_REPEAT);
  constexpr float kOffsets[] = {0, 1, 1024, 32768, 1048576, -1, -1024, -1048576};
  const int h = stage.height / 8;
  if (h == 0) return;
  for (int strip = 0; strip < 8; ++strip) {
    glViewport(0, strip * h, stage.width, h);
    const float offset = kOffsets[strip];
    glBegin(GL_QUADS);
    // A plane in perspective; w from 1 to 4. Multiples of 1/8 are exact even at 2^20.
    const float corners[4][4] = {
        {-1, -1, 0, 0.125f}, {1, -1, 3.5f, 0}, {1, 1, 4.25f, 1.5f}, {-1, 1, 0.5f, 1.25f}};
    const float w[4] = {1, 4, 4, 1};
    for (int k = 0; k < 4; ++k) {
      glTexCoord2f(corners[k][2] + offset, corners[k][3] - offset);
      glVertex4f(corners[k][0] * w[k], corners[k][1] * w[k], 0, w[k]);
    }
    glEnd();
  }
  const Picture picture = stage.read();
  stage.expect(picture, [&](int x, int y) {
    if (y >= 8 * h) return std::vector<Rgb>{};
    const uint8_t* p = picture.pixel(x, y % h);
    return std::vector<Rgb>{{p[0], p[1], p[2]}};
  });
}

void texture_seams(Stage& stage) {
  // 32 texels a row; at each pixel's centre u = k / 32 exactly, and v = k / 32.
  constexpr int kTexels = 32;
  const auto texels = noise(62, kTexels, kTexels);
  bind_texture(texels, kTexels, kTexels, GL_NEAREST, GL_REPEAT);
  pixel_view(stage);
  const auto coordinate = [](int pixel_edge) { return (float(pixel_edge) - 0.5f) / kTexels; };
  glBegin(GL_QUADS);
  const int w = stage.width, h = stage.height;
  for (const auto& [x, y] : {std::pair{0, 0}, {w, 0}, {w, h}, {0, h}}) {
    glTexCoord2f(coordinate(x), coordinate(y));
    glVertex2f(float(x), float(y));
  }
  glEnd();
  stage.expect(stage.read(), [&](int x, int y) {
    const uint8_t* p = &texels[4 * size_t(y % kTexels * kTexels + x % kTexels)];
    return std::vector<Rgb>{{p[0], p[1], p[2]}};
  });
}

void lod_ramp(Stage& stage) {
  // Level k is the constant 28 k, so that a pixel's level can be read off it.
  constexpr int kLevels = 9, kStep = 28, kSize = 256;
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  for (int level = 0; level < kLevels; ++level) {
    const int size = kSize >> level;
    const std::vector<uint8_t> texels(4 * size_t(size) * size_t(size), uint8_t(level * kStep));
    glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA8, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
  }
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
  glEnable(GL_TEXTURE_2D);
  // 1/w runs from 16 to 1 along x: u(x) = c x / (16 - 15 x), du/dx = 16 c / (16 - 15 x)^2, x in [0, 1]. With
  // this c the level runs from -1 to 7 (spec 3.8.8: lambda = log2 of texels a pixel).
  const double width = stage.width, c = 8 * width / kSize;
  const double u_end = c;
  glBegin(GL_QUADS);
  for (int corner = 0; corner < 4; ++corner) {
    const bool right = corner == 1 || corner == 2, top = corner >= 2;
    const float w = right ? 16 : 1;
    glTexCoord2f(right ? float(u_end) : 0, 0.5f);
    glVertex4f(right ? w : -w, top ? w : -w, 0, w);
  }
  glEnd();
  const Picture picture = stage.read();
  double worst = 0;
  for (int y = 0; y < stage.height; ++y) {
    for (int x = 0; x < stage.width; ++x) {
      const double at = (x + 0.5) / width, g = 16 - 15 * at;
      const double lambda = std::log2(kSize * 16 * c / (g * g) / width);
      const double want = kStep * std::fmin(std::fmax(lambda, 0), kLevels - 1);
      worst = std::fmax(worst, std::fabs(picture.pixel(x, y)[0] - want));
    }
  }
  // The level's error, and half a level of colour for rounding.
  if (worst > kStep / 64.0 + 0.55)
    stage.complain("lambda is off by " + std::to_string((worst - 0.55) / kStep));
}

void texture_1x1(Stage& stage) {
  const std::vector<uint8_t> texel{201, 103, 7, 255};
  constexpr GLint kFilters[] = {GL_NEAREST, GL_LINEAR},
                  kMinFilters[] = {GL_NEAREST_MIPMAP_LINEAR, GL_LINEAR_MIPMAP_LINEAR};
  pixel_view(stage);
  for (int i = 0; i < 8; ++i) {
    bind_texture(texel, 1, 1, kFilters[i % 2], GL_REPEAT);
    if (i & 2) glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, kMinFilters[i % 2]);
    const float x0 = float(stage.width * i / 8), x1 = float(stage.width * (i + 1) / 8);
    glBegin(GL_QUADS);
    const float reach = i & 4 ? 4096 : 0.7f;
    glTexCoord2f(-reach, -3), glVertex2f(x0, 0);
    glTexCoord2f(reach, -3), glVertex2f(x1, 0);
    glTexCoord2f(reach, reach), glVertex2f(x1, float(stage.height));
    glTexCoord2f(-reach, reach), glVertex2f(x0, float(stage.height));
    glEnd();
  }
  stage.expect_all({201, 103, 7});
}

void texture_borders(Stage& stage) {
  // 8 x 8 texels of noise inside a border of one colour.
  constexpr int kSize = 10;
  auto texels = noise(63, kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      if (x != 0 && y != 0 && x != kSize - 1 && y != kSize - 1) continue;
      const uint8_t border[4] = {250, 200, 0, 255};
      std::copy_n(border, 4, &texels[4 * size_t(y * kSize + x)]);
    }
  }
  constexpr GLint kWrap[] = {GL_CLAMP, GL_REPEAT}, kFilter[] = {GL_LINEAR, GL_NEAREST};
  for (int quarter = 0; quarter < 4; ++quarter) {
    bind_texture(texels, kSize, kSize, kFilter[quarter % 2], kWrap[quarter / 2], 1);
    const int w = stage.width / 2, h = stage.height / 2;
    glViewport(quarter % 2 * w, quarter / 2 * h, w, h);
    glBegin(GL_QUADS);
    glTexCoord2f(-0.5f, -0.5f), glVertex2f(-1, -1);
    glTexCoord2f(1.5f, -0.5f), glVertex2f(1, -1);
    glTexCoord2f(1.5f, 1.5f), glVertex2f(1, 1);
    glTexCoord2f(-0.5f, 1.5f), glVertex2f(-1, 1);
    glEnd();
  }
  // Beyond 1, clamped (spec 3.8.7, 3.8.8): NEAREST stays on the last texel inside; LINEAR stands half-way
  // between it and the border, in the corner in both directions.
  const Picture picture = stage.read();
  const int w = stage.width / 2, h = stage.height / 2;
  const uint8_t* last = &texels[4 * (8 * kSize + 8)];
  stage.expect(picture, [&](int x, int y) {
    const bool nearest = x >= w;
    if (x >= 2 * w || y >= h || x % w < w * 3 / 4 + 1 || y < h * 3 / 4 + 1) return std::vector<Rgb>{};
    if (nearest) return std::vector<Rgb>{{last[0], last[1], last[2]}};
    const auto mixed = [](int texel, int border, int up) { return (texel + 3 * border + up) / 4; };
    // Half a level may go either way.
    std::vector<Rgb> both;
    for (int up : {1, 2})
      both.push_back({mixed(last[0], 250, up), mixed(last[1], 200, up), mixed(last[2], 0, up)});
    return both;
  });
}

}  // namespace halfspace::hard
