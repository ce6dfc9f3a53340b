// Clip coordinates and matrices at the ends of what floats can hold.
#include <algorithm>
#include <cmath>
#include <limits>

#include "cases.h"

namespace halfspace::hard {
namespace {

// 64 x 64 texels: a checkerboard whose every level is made by averaging, so that it turns grey far away.
void bind_checkerboard() {
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  for (int level = 0, size = 64; size >= 1; ++level, size /= 2) {
    std::vector<uint8_t> texels;
    const int cell = size / 2;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const bool light = cell > 0 && (x / cell + y / cell) % 2 == 0;
        const uint8_t v = cell == 0 ? 130 : light ? 230 : 30;
        texels.insert(texels.end(), {v,
                                     cell == 0 ? uint8_t(120)
                                     : light   ? uint8_t(210)
                                               : uint8_t(30),
                                     cell == 0 ? uint8_t(110)
                                     : light   ? uint8_t(160)
                                               : uint8_t(60),
                                     255});
      }
    }
    glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA8, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
  }
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
  glEnable(GL_TEXTURE_2D);
}

// Of a triangle, one corner gets one of these as one of its coordinates.
std::vector<float> odd_numbers() {
  using Limits = std::numeric_limits<float>;
  return {0,
          -0.0f,
          -1,
          -0.5f,
          1e-10f,
          -1e-10f,
          1e-38f,
          Limits::denorm_min(),
          1e10f,
          1e20f,
          1e38f,
          -1e38f,
          Limits::max(),
          Limits::infinity(),
          -Limits::infinity(),
          Limits::quiet_NaN()};
}

// A sphere by rings, normals as long as they come.
void draw_sphere(float x, float y, float radius) {
  constexpr int kRings = 12, kSides = 20;
  for (int j = 0; j < kRings; ++j) {
    glBegin(GL_QUAD_STRIP);
    for (int i = 0; i <= kSides; ++i) {
      for (int k = 1; k >= 0; --k) {
        const SineCosine around = sine_cosine(double(i) / kSides - 0.5),
                         up = sine_cosine((j + k) / (2.0 * kRings) - 0.25);
        const double n[3] = {up.cosine * around.sine, up.sine, up.cosine * around.cosine};
        glNormal3d(n[0], n[1], n[2]);
        glVertex3d(double(x + radius * float(n[0])), double(y + radius * float(n[1])), double(radius) * n[2]);
      }
    }
    glEnd();
  }
}

}  // namespace

void floor_to_horizon(Stage& stage) {
  square_view(1e-4, 1e6);
  bind_checkerboard();
  glEnable(GL_DEPTH_TEST);
  glRotatef(10, 0, 0, 1);
  glClearColor(0, 0, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glBegin(GL_QUADS);
  const float kReach = 524288;
  for (const auto& [x, z] :
       {std::pair{-kReach, 2.0f}, {kReach, 2.0f}, {kReach, -kReach}, {-kReach, -kReach}}) {
    glTexCoord2f(x / 4, z / 4);
    glVertex3f(x, -1, z);
  }
  glEnd();
  // Floor and sky are each where they have to be; between them lies a line through the middle.
  const Picture picture = stage.read();
  const double c = std::cos(0.17453292519943295), s = std::sin(0.17453292519943295);
  stage.expect(picture, [&](int x, int y) {
    const double up = (2 * (y + 0.5) / stage.height - 1) * c - (2 * (x + 0.5) / stage.width - 1) * s;
    const uint8_t* p = picture.pixel(x, y);
    const bool sky = p[0] == 0 && p[1] == 0 && p[2] == 255;
    if (std::fabs(up) < 0.02 || sky == (up > 0)) return std::vector<Rgb>{};
    return up > 0 ? std::vector<Rgb>{{0, 0, 255}} : std::vector<Rgb>{{130, 120, 110}};
  });
}

void odd_positions(Stage& stage) {
  const std::vector<float> numbers = odd_numbers();
  glEnable(GL_SCISSOR_TEST);
  constexpr int kCells = 8;
  const auto edge = [](int size, int k) { return size * k / kCells; };
  for (int cell = 0; cell < kCells * kCells; ++cell) {
    const int i = cell % kCells, j = cell / kCells;
    const int x0 = edge(stage.width, i), y0 = edge(stage.height, j), w = edge(stage.width, i + 1) - x0,
              h = edge(stage.height, j + 1) - y0;
    if (w == 0 || h == 0) continue;
    glViewport(x0, y0, w, h);
    glScissor(x0, y0, w, h);
    float bad[3][4] = {{-0.8f, 0.1f, 0, 1}, {0.7f, 0.3f, 0.2f, 1}, {-0.2f, 0.9f, -0.3f, 1}};
    bad[cell % 3][cell / 16] = numbers[size_t(cell % 16)];
    glBegin(GL_TRIANGLES);
    const float good[3][2] = {{-1, -1}, {1, -1}, {1, 0}};
    for (int k = 0; k < 3; ++k) glColor3f(1, 0.5f * float(k), 0), glVertex4fv(bad[k]);
    glEnd();
    // In one batch with a bad triangle on either side, these two are as ever.
    const float corners[6][2] = {{good[0][0], good[0][1]}, {1, -1}, {1, 0}, {-1, -1}, {1, 0}, {-1, 0}};
    glBegin(GL_TRIANGLES);
    for (int k = 0; k < 3; ++k) glColor3f(0, 0, 1), glVertex2fv(corners[k]);
    for (int k = 0; k < 3; ++k) glVertex4f(1, bad[k][1], std::numeric_limits<float>::quiet_NaN(), 1);
    for (int k = 3; k < 6; ++k) glVertex2fv(corners[k]);
    glEnd();
  }
  stage.expect(stage.read(), [&](int x, int y) {
    const int i = (x * kCells + kCells - 1) / stage.width, j = (y * kCells + kCells - 1) / stage.height;
    int cell = -1, low = 0, high = 0;
    for (int dj = -1; dj <= 1; ++dj) {
      for (int di = -1; di <= 1; ++di) {
        const int ci = i + di, cj = j + dj;
        if (x < edge(stage.width, ci) || x >= edge(stage.width, ci + 1) || y < edge(stage.height, cj) ||
            y >= edge(stage.height, cj + 1))
          continue;
        cell = cj * kCells + ci, low = edge(stage.height, cj), high = edge(stage.height, cj + 1);
      }
    }
    if (2 * (y - low) + 1 < high - low) return std::vector<Rgb>{{0, 0, 255}};
    const float number = numbers[size_t(cell % 16)];
    // Spec 2.11 leaves it open; here what has no position is not drawn.
    return std::isfinite(number) ? std::vector<Rgb>{} : std::vector<Rgb>{{0, 0, 0}};
  });
}

void million_rotations(Stage& stage) {
  glMatrixMode(GL_MODELVIEW);
  // 0.5625 is a short binary fraction: a million steps are 1562 turns and a half.
  for (int i = 0; i < 1'000'000; ++i) glRotatef(0.5625f, 0, 0, 1);
  float m[16];
  glGetFloatv(GL_MODELVIEW_MATRIX, m);
  const double want[16] = {-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  double worst = 0;
  for (int i = 0; i < 16; ++i) worst = std::max(worst, std::fabs(double(m[i]) - want[i]));
  // A step rounds an element of at most 1 by half an ulp of [0.5, 1), 2^-25, and there are a million.
  if (worst > 1e6 / 33554432) stage.complain("drifted by " + std::to_string(worst));
  // The drift made visible: the same hand, turned back by hand, in another channel.
  const auto hand = [] {
    glBegin(GL_TRIANGLES);
    glVertex2f(-0.1f, -0.6f), glVertex2f(0.1f, -0.6f), glVertex2f(0, 0.9f);
    glEnd();
  };
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  glColor3ub(250, 0, 0);
  hand();
  glLoadIdentity();
  glRotatef(180, 0, 0, 1);
  glColor3ub(0, 250, 200);
  hand();
}

void near_singular(Stage& stage) {
  glMatrixMode(GL_PROJECTION);
  glOrtho(0, 4, 0, 4, -10, 10);
  glMatrixMode(GL_MODELVIEW);
  glEnable(GL_LIGHTING);
  glEnable(GL_LIGHT0);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_NORMALIZE);
  const float light[4] = {0.5f, 0.7f, 1, 0}, half[4] = {0.5f, 0.5f, 0.5f, 1};
  glLightfv(GL_LIGHT0, GL_POSITION, light);
  glLightfv(GL_LIGHT0, GL_SPECULAR, half);
  glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, half);
  glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, 20);
  const float squash[] = {1, 1e-3f, 1e-6f, 1e-12f, 1e-20f, 1e-30f, 1e-38f, 0};
  for (int i = 0; i < 16; ++i) {
    glLoadIdentity();
    glTranslatef(0.5f + float(i % 4), 0.5f + float(i / 4), 0);
    glRotatef(30, 1, 0.3f, 0);
    if (i < 8)
      glScalef(0.45f, 0.45f, squash[i]);
    else
      glScalef(squash[i - 8], squash[i - 8], squash[i - 8]);  // the whole, but drawn as large as ever
    const float size = i < 8 ? 1 : std::min(0.45f / std::max(squash[i - 8], 1e-38f), 3e37f);
    draw_sphere(0, 0, size);
  }
  if (glGetError() != GL_NO_ERROR) stage.complain("an error was recorded");
}

}  // namespace halfspace::hard
