#include "stage.h"

#include <algorithm>

namespace halfspace::hard {

void Stage::complain(const std::string& text) {
  if (complaints_.size() < 5 && !show) complaints_.push_back(text);
}

Picture Stage::read() const {
  Picture picture;
  picture.width = width;
  picture.height = height;
  picture.rgba.resize(4 * size_t(width) * size_t(height));
  picture.depth.resize(size_t(width) * size_t(height));
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, picture.rgba.data());
  glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, picture.depth.data());
  for (uint32_t& d : picture.depth) d >>= 8;
  return picture;
}

void Stage::expect(const Picture& picture, const std::function<std::vector<Rgb>(int, int)>& want) {
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const uint8_t* p = picture.pixel(x, y);
      const Rgb got{p[0], p[1], p[2]};
      const std::vector<Rgb> allowed = want(x, y);
      if (allowed.empty() || std::find(allowed.begin(), allowed.end(), got) != allowed.end()) continue;
      const Rgb& first = allowed.front();
      complain("pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") is " + std::to_string(got.r) +
               " " + std::to_string(got.g) + " " + std::to_string(got.b) + ", not " +
               std::to_string(first.r) + " " + std::to_string(first.g) + " " + std::to_string(first.b));
    }
  }
}

void Stage::expect_all(const Rgb& want) {
  expect(read(), [&](int, int) { return std::vector<Rgb>{want}; });
}

void pixel_view(const Stage& stage) {
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glOrtho(0, stage.width, 0, stage.height, -1, 1);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
}

void square_view(double near, double far) {
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glFrustum(-near, near, -near, near, near, far);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
}

void count_fragments(const Stage& stage) {
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  if (stage.show) glDisable(GL_BLEND);
  glColor3ub(kOnce, kOnce, kOnce);
}

SineCosine sine_cosine(double turns) {
  // Taylor's series; at half a turn the first term left out is below 10^-10.
  const double x = 6.283185307179586 * turns;
  SineCosine sum{x, 1};
  double power = x;
  for (int n = 2; n < 24; ++n) {
    power *= x / n;
    double& term = n % 2 ? sum.sine : sum.cosine;
    term += n / 2 % 2 ? -power : power;
  }
  return sum;
}

void rectangle(float x0, float y0, float x1, float y1, float z) {
  glBegin(GL_QUADS);
  glVertex3f(x0, y0, z);
  glVertex3f(x1, y0, z);
  glVertex3f(x1, y1, z);
  glVertex3f(x0, y1, z);
  glEnd();
}

std::vector<uint8_t> noise(uint64_t seed, int width, int height) {
  Random random(seed);
  std::vector<uint8_t> texels(4 * size_t(width) * size_t(height));
  for (uint8_t& byte : texels) byte = uint8_t(random.integer(0, 255));
  return texels;
}

void bind_texture(const std::vector<uint8_t>& rgba, int width, int height, GLint filter, GLint wrap,
                  int border) {
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, border, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
  glEnable(GL_TEXTURE_2D);
}

}  // namespace halfspace::hard
