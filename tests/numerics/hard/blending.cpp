// Blending rounds once: to the nearest of the 256 levels.
#include <algorithm>
#include <cmath>

#include "cases.h"

namespace halfspace::hard {
namespace {

// (s a + d (255 - a)) / 255, to the nearest.
int blended(int s, int d, int a) { return (2 * (s * a + d * (255 - a)) + 255) / 510; }

// Columns of one pixel, `top` pixels high, the k-th with the colour column(k).
template <typename Column>
void columns(const Stage& stage, float top, const Column& column) {
  glBegin(GL_QUADS);
  for (int x = 0; x < stage.width; ++x) {
    column(x);
    const auto x0 = float(x), x1 = x0 + 1;
    glVertex2f(x0, 0), glVertex2f(x1, 0), glVertex2f(x1, top), glVertex2f(x0, top);
  }
  glEnd();
}

// Row y holds the destination y, column x brings the source x with this alpha.
void draw_triples(Stage& stage, int alpha) {
  glDisable(GL_BLEND);
  glBegin(GL_QUADS);
  for (int y = 0; y < stage.height; ++y) {
    const auto d = GLubyte(y % 256);
    glColor4ub(d, d, d, d);
    const auto y0 = float(y), y1 = y0 + 1, right = float(stage.width);
    glVertex2f(0, y0), glVertex2f(right, y0), glVertex2f(right, y1), glVertex2f(0, y1);
  }
  glEnd();
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  columns(stage, float(stage.height), [&](int x) {
    const auto s = GLubyte(x % 256);
    glColor4ub(s, GLubyte(255 - s), s / 2, GLubyte(alpha));
  });
}

void expect_triples(Stage& stage, int alpha) {
  const Picture picture = stage.read();
  size_t wrong = 0;
  for (int y = 0; y < stage.height; ++y) {
    for (int x = 0; x < stage.width; ++x) {
      const uint8_t* p = picture.pixel(x, y);
      const int s = x % 256, d = y % 256;
      wrong += p[0] != blended(s, d, alpha) || p[1] != blended(255 - s, d, alpha) ||
               p[2] != blended(s / 2, d, alpha);
    }
  }
  if (wrong) stage.complain(std::to_string(wrong) + " blends are wrong at alpha " + std::to_string(alpha));
}

}  // namespace

void thousand_blends(Stage& stage) {
  constexpr int kPasses = 1000, kRows = 16;
  constexpr Rgb kSource{255, 130, 10}, kStart{9, 17, 33};
  pixel_view(stage);
  glClearColor(kStart.r / 255.0f, kStart.g / 255.0f, kStart.b / 255.0f, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  const auto alpha = [](int x) { return x % 16; };
  // Sixteen alphas, each over a column of pixels, and every pass drawn on its own.
  for (int pass = 0; pass < kPasses; ++pass)
    columns(stage, kRows, [&](int x) { glColor4ub(kSource.r, kSource.g, kSource.b, GLubyte(alpha(x))); });
  stage.expect(stage.read(), [&](int x, int y) {
    int c[3] = {kStart.r, kStart.g, kStart.b};
    const int s[3] = {kSource.r, kSource.g, kSource.b};
    for (int pass = 0; pass < (y < kRows ? kPasses : 0); ++pass)
      for (int k = 0; k < 3; ++k) c[k] = blended(s[k], c[k], alpha(x));
    return std::vector<Rgb>{{c[0], c[1], c[2]}};
  });
}

void blend_triples(Stage& stage) {
  pixel_view(stage);
  if (stage.sweep) {
    for (int alpha = 0; alpha < 256; ++alpha) {
      draw_triples(stage, alpha);
      expect_triples(stage, alpha);
    }
  }
  draw_triples(stage, 77);
  expect_triples(stage, 77);
}

}  // namespace halfspace::hard
