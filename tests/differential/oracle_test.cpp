// The oracle against values worked out by hand from the specification: small cases with a closed form, each
// by another way than the oracle's own. It is driven as any program would, through its libOSMesa.
#include <GL/gl.h>
#include <GL/osmesa.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <optional>

#include "tests/differential/true_frame.h"
#include "tests/support/temporary_folder.h"

namespace halfspace::differential {
namespace {

constexpr double kSteps = 16777215;
constexpr double kPi = 3.14159265358979323846;

class Oracle : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder.emplace();
    setenv("HALFSPACE_TRUTH", folder->path().c_str(), 1);
  }
  static void TearDownTestSuite() { folder.reset(); }

  void TearDown() override { close(); }

  // A window in which one unit is a pixel, x and y from 0; z_w = (z + 1) / 2.
  void open(int width, int height) {
    close();
    pixels_.assign(4 * static_cast<size_t>(width) * static_cast<size_t>(height), 0);
    context_ = OSMesaCreateContextExt(OSMESA_RGBA, 24, 8, 16, nullptr);
    ASSERT_TRUE(OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, width, height));
    ASSERT_EQ(
        std::string(reinterpret_cast<const char*>(glGetString(GL_RENDERER))).rfind("Halfspace oracle", 0),
        0u);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0, width, 0, height, 1, -1);
    glMatrixMode(GL_MODELVIEW);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  }
  void close() {
    if (context_) OSMesaDestroyContext(context_);
    context_ = nullptr;
  }
  TrueFrame shown() {
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
    glFinish();
    const TrueFrame frame = read_last_frame(folder->path().string());
    remove_frames(folder->path().string());
    return frame;
  }
  static void fill(double x0, double y0, double x1, double y1, double z = 0) {
    glBegin(GL_QUADS);
    glVertex3d(x0, y0, z), glVertex3d(x1, y0, z), glVertex3d(x1, y1, z), glVertex3d(x0, y1, z);
    glEnd();
  }
  static int count(const TrueFrame& frame) {
    int owned = 0;
    for (const TruePixel& pixel : frame.pixels) owned += pixel.owner != 0;
    return owned;
  }
  // One pixel's colour after `draw` has drawn over all of a 2 x 2 window.
  template <class Draw>
  std::array<float, 4> one_pixel(Draw draw) {
    open(2, 2);
    draw();
    return shown().at(0, 0).level;
  }

  static std::optional<test::TemporaryFolder> folder;

 private:
  OSMesaContext context_ = nullptr;
  std::vector<uint8_t> pixels_;
};

std::optional<test::TemporaryFolder> Oracle::folder;

void expect_level(const std::array<float, 4>& level, std::array<double, 4> expected, double error = 1e-4) {
  for (size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(static_cast<double>(level[k]), expected[k], error) << "component " << k;
}

TEST_F(Oracle, LeftAndTopEdgesOwnTheirCentres) {
  open(4, 4);
  fill(0.5, 0.5, 2.5, 2.5);
  const TrueFrame frame = shown();
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      EXPECT_EQ(frame.at(x, y).owner, x <= 1 && y >= 1 && y <= 2 ? 1u : 0u) << x << " " << y;
}

TEST_F(Oracle, ColorIsLinearOverTheWindow) {
  open(16, 16);
  glBegin(GL_TRIANGLES);
  glColor3d(0, 0, 1), glVertex2d(0, 0);
  glColor3d(1, 0, 0), glVertex2d(16, 0);
  glColor3d(0, 1, 0), glVertex2d(0, 16);
  glEnd();
  const TrueFrame frame = shown();
  for (int y = 0; y < 15; ++y) {
    for (int x = 0; x + y < 15; ++x) {
      const double r = (x + 0.5) / 16, g = (y + 0.5) / 16;
      expect_level(frame.at(x, y).level, {255 * r, 255 * g, 255 * (1 - r - g), 255});
    }
  }
}

// A floor through the near plane to far away, coloured by its depth: each pixel against the ray through it.
TEST_F(Oracle, FloorAgreesWithARayCast) {
  constexpr int kSize = 64;
  open(kSize, kSize);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glFrustum(-1, 1, -1, 1, 1, 1024);
  glEnable(GL_DEPTH_TEST);
  glBegin(GL_QUADS);  // y = -0.5, z from before the eye to -512; red is -z / 512 where that is in [0, 1]
  glColor3d(0, 0.25, 1), glVertex3d(-900, -0.5, 0), glVertex3d(900, -0.5, 0);
  glColor3d(1, 0.25, 0), glVertex3d(900, -0.5, -512), glVertex3d(-900, -0.5, -512);
  glEnd();
  const TrueFrame frame = shown();
  int seen = 0;
  for (int y = 0; y < kSize / 2; ++y) {
    const double slope = (y + 0.5) / kSize * 2 - 1, z = -0.5 / slope;  // the ray (x, slope, -1) * z
    if (z < 1.01 || z > 511) continue;
    for (int x = 0; x < kSize; ++x, ++seen) {
      expect_level(frame.at(x, y).level, {255 * z / 512, 255 * 0.25, 255 * (1 - z / 512), 255}, 2e-3);
      const double ndc = (1025.0 / 1023 * z - 2 * 1024.0 / 1023) / z;
      EXPECT_NEAR(frame.at(x, y).depth, (ndc + 1) / 2 * kSteps, 2);  // the matrix is of floats
    }
  }
  EXPECT_GT(seen, 20 * kSize / 2);
}

TEST_F(Oracle, DepthIsThePlanesOwn) {
  open(8, 8);
  glEnable(GL_DEPTH_TEST);
  glDepthRange(0.25, 0.75);
  glBegin(GL_TRIANGLES);  // z = x / 8 - y / 16
  glVertex3d(0, 0, 0), glVertex3d(8, 0, 1), glVertex3d(0, 8, -0.5);
  glEnd();
  const TrueFrame frame = shown();
  for (int y = 0; y < 7; ++y) {
    for (int x = 0; x + y < 7; ++x) {
      const double z = (x + 0.5) / 8 - (y + 0.5) / 16;
      EXPECT_NEAR(frame.at(x, y).depth, (0.25 * z + 0.5) * kSteps, 1e-6) << x << " " << y;
    }
  }
}

TEST_F(Oracle, PolygonOffset) {
  open(8, 8);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(2, 3);
  glBegin(GL_TRIANGLES);  // dz_w/dx = 1/32, dz_w/dy = -1/64
  glVertex3d(0, 0, -0.25), glVertex3d(8, 0, 0.25), glVertex3d(0, 8, -0.5);
  glEnd();
  const TrueFrame frame = shown();
  const double z = ((-0.25 + 0.5 / 16 - 0.5 / 32) + 1) / 2;
  EXPECT_NEAR(frame.at(0, 0).depth, (z + 2.0 / 32) * kSteps + 3, 1e-6);
}

void texture(int level, int width, int height, const std::vector<uint8_t>& rgba) {
  glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
}
void filters(GLint min, GLint mag, GLint wrap) {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, min);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, mag);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
  glEnable(GL_TEXTURE_2D);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
}
void fill_textured(double width, double height, double s, double t) {
  glBegin(GL_QUADS);
  glTexCoord2d(0, 0), glVertex2d(0, 0);
  glTexCoord2d(s, 0), glVertex2d(width, 0);
  glTexCoord2d(s, t), glVertex2d(width, height);
  glTexCoord2d(0, t), glVertex2d(0, height);
  glEnd();
}

// Two texels, 0 and 240 in red, over eight pixels: u - 1/2 = (x + 1/2) / 4 - 1/2.
TEST_F(Oracle, BilinearFilterAndItsWraps) {
  const auto reds = [this](GLint wrap, const float* border) {
    open(8, 1);
    texture(0, 2, 1, {0, 0, 0, 255, 240, 0, 0, 255});
    filters(GL_LINEAR, GL_LINEAR, wrap);
    if (border) glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border);
    fill_textured(8, 1, 1, 1);
    const TrueFrame frame = shown();
    std::vector<double> red;
    for (int x = 0; x < 8; ++x) red.push_back(static_cast<double>(frame.at(x, 0).level[0]));
    return red;
  };
  const std::vector<double> inside{30, 90, 150, 210};  // pixels 2 .. 5, whatever the wrap
  const float border[4] = {100.0f / 255, 0, 0, 1};
  const struct {
    GLint wrap;
    double first, second;
  } cases[] = {{GL_REPEAT, 240 * 0.375, 240 * 0.125}, {0x812F, 0, 0}, {GL_CLAMP, 100 * 0.375, 100 * 0.125}};
  for (const auto& c : cases) {
    const std::vector<double> red = reds(c.wrap, border);
    EXPECT_NEAR(red[0], c.first, 1e-4);
    EXPECT_NEAR(red[1], c.second, 1e-4);
    // GL_CLAMP mixes the border's colour over all of v, too: t lies in the middle of the only row, so not
    // here.
    for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(red[i + 2], inside[i], 1e-4);
  }
}

// 2^1.5 texels a pixel: between levels 1 and 2, half way.
TEST_F(Oracle, LevelOfDetail) {
  for (const bool linear : {true, false}) {
    open(8, 8);
    for (int level = 0, size = 64; size > 0; ++level, size /= 2)
      texture(level, size, size,
              std::vector<uint8_t>(4 * static_cast<size_t>(size * size), static_cast<uint8_t>(40 * level)));
    filters(linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_NEAREST, GL_LINEAR, GL_REPEAT);
    // Along x 2^1.25 texels a pixel, along y 2: the longer counts.
    fill_textured(8, 8, 8 * std::pow(2, 1.25) / 64, 8 * 2.0 / 64);
    const double red = static_cast<double>(shown().at(3, 3).level[0]);
    EXPECT_NEAR(red, linear ? 40 * 1.25 : 40, 1e-4);
  }
}

TEST_F(Oracle, FogByTheSpecificationsFormulas) {
  const struct {
    GLint mode;
    double factor;
  } cases[] = {{GL_LINEAR, (0.9 - 0.5) / (0.9 - 0.1)},
               {GL_EXP, std::exp(-0.7 * 0.5)},
               {GL_EXP2, std::exp(-0.7 * 0.5 * 0.7 * 0.5)}};
  for (const auto& c : cases) {
    const auto level = one_pixel([&] {
      const float color[4] = {1, 0, 0.5f, 0};
      glFogfv(GL_FOG_COLOR, color);
      glFogi(GL_FOG_MODE, c.mode);
      glFogf(GL_FOG_START, 0.1f), glFogf(GL_FOG_END, 0.9f), glFogf(GL_FOG_DENSITY, 0.7f);
      glEnable(GL_FOG);
      glColor4d(0, 1, 0.5, 0.25);
      fill(0, 0, 2, 2, 0.5);
    });
    expect_level(level, {255 * (1 - c.factor), 255 * c.factor, 127.5, 63.75}, 1e-3);
  }
}

// Spec 2.14.1 with every term: a local light with attenuation and a cone, a material with all four colours.
TEST_F(Oracle, LightingEquation) {
  const auto level = one_pixel([] {
    const float position[4] = {1, 1, 3, 1}, down[3] = {0, 0.6f, -0.8f}, black[4] = {0, 0, 0, 1};
    const float light_ambient[4] = {0.5f, 0, 0, 1}, light_diffuse[4] = {0, 0.75f, 0, 1},
                light_specular[4] = {0, 0, 1, 1};
    const float ambient[4] = {0.5f, 1, 1, 1}, diffuse[4] = {1, 0.5f, 1, 0.375f},
                specular[4] = {1, 1, 0.25f, 1}, emission[4] = {0.125f, 0, 0, 1};
    glLightfv(GL_LIGHT0, GL_POSITION, position);
    glLightfv(GL_LIGHT0, GL_SPOT_DIRECTION, down);
    glLightf(GL_LIGHT0, GL_SPOT_CUTOFF, 60), glLightf(GL_LIGHT0, GL_SPOT_EXPONENT, 2);
    glLightf(GL_LIGHT0, GL_CONSTANT_ATTENUATION, 0.5f), glLightf(GL_LIGHT0, GL_LINEAR_ATTENUATION, 0.25f);
    glLightfv(GL_LIGHT0, GL_AMBIENT, light_ambient), glLightfv(GL_LIGHT0, GL_DIFFUSE, light_diffuse);
    glLightfv(GL_LIGHT0, GL_SPECULAR, light_specular);
    glMaterialfv(GL_FRONT, GL_AMBIENT, ambient), glMaterialfv(GL_FRONT, GL_DIFFUSE, diffuse);
    glMaterialfv(GL_FRONT, GL_SPECULAR, specular), glMaterialfv(GL_FRONT, GL_EMISSION, emission);
    glMaterialf(GL_FRONT, GL_SHININESS, 3);
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, black);
    glEnable(GL_LIGHTING), glEnable(GL_LIGHT0);
    glShadeModel(GL_FLAT);
    glNormal3d(0, 0.8, 0.6);
    glBegin(GL_TRIANGLES);  // the last vertex gives the colour: 3 below the light
    glVertex2d(-9, -9), glVertex2d(20, -9), glVertex2d(1, 1);
    glEnd();
    glBegin(GL_TRIANGLES);
    glVertex2d(-9, 20), glVertex2d(-9, -9), glVertex2d(1, 1);
    glEnd();
  });
  const double weight = 1 / (0.5 + 0.25 * 3) * std::pow(0.8, 2), n_l = 0.6;
  const double shine = std::pow(0.6, 3);  // the eye is infinitely far up z: h is (0, 0, 1)
  expect_level(
      level,
      {255 * (0.125 + weight * 0.25), 255 * weight * n_l * 0.375, 255 * weight * shine * 0.25, 255 * 0.375},
      1e-3);
}

TEST_F(Oracle, BlendsBytesAndRoundsOnce) {
  // s = (200, 100, 50, 64), d = (10, 20, 30, 128), all of 255.
  const double s[4] = {200, 100, 50, 64}, d[4] = {10, 20, 30, 128};
  const auto blended = [this](GLenum source, GLenum destination) {
    return one_pixel([&] {
      glClearColor(10 / 255.0f, 20 / 255.0f, 30 / 255.0f, 128 / 255.0f);
      glClear(GL_COLOR_BUFFER_BIT);
      glEnable(GL_BLEND);
      glBlendFunc(source, destination);
      glColor4ub(200, 100, 50, 64);
      fill(0, 0, 2, 2);
    });
  };
  const double a = 64.0 / 255, b = 128.0 / 255;
  const auto expected = [&](auto f) { return std::array<double, 4>{f(0), f(1), f(2), f(3)}; };
  expect_level(blended(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA),
               expected([&](int k) { return s[k] * a + d[k] * (1 - a); }));
  expect_level(blended(GL_DST_COLOR, GL_SRC_COLOR), expected([&](int k) { return 2 * s[k] * d[k] / 255; }));
  expect_level(blended(GL_ONE_MINUS_DST_COLOR, GL_DST_ALPHA),
               expected([&](int k) { return s[k] * (255 - d[k]) / 255 + d[k] * b; }));
  expect_level(blended(GL_SRC_ALPHA_SATURATE, GL_ONE),
               expected([&](int k) { return k == 3 ? 192 : s[k] * a + d[k]; }));
}

TEST_F(Oracle, LogicOpsTruthTable) {
  // 0b1100 and 0b1010 meet in every way.
  for (int op = 0; op < 16; ++op) {
    const auto level = one_pixel([&] {
      glClearColor(0b1010 / 255.0f, 0, 0, 0);
      glClear(GL_COLOR_BUFFER_BIT);
      glEnable(GL_COLOR_LOGIC_OP);
      glLogicOp(static_cast<GLenum>(GL_CLEAR + op));
      glColor4ub(0b1100, 0, 0, 0);
      fill(0, 0, 2, 2);
    });
    // GL's numbers are the table: bit 3 for (0, 0), 2 for (0, 1), 1 for (1, 0), 0 for (1, 1), source first.
    int expected = 0;
    for (int bit = 0; bit < 8; ++bit) {
      const int s = 0b1100 >> bit & 1, d = 0b1010 >> bit & 1;
      expected |= (op >> (3 - (2 * s + d)) & 1) << bit;
    }
    EXPECT_EQ(static_cast<int>(level[0]), expected) << "operation " << op;
  }
}

TEST_F(Oracle, AccumulatesInSteps) {
  const auto level = one_pixel([] {
    glClearColor(0.25f, 0.5f, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glAccum(GL_LOAD, 0.5f), glAccum(GL_ACCUM, 0.25f), glAccum(GL_MULT, 0.5f), glAccum(GL_ADD, 0.125f);
    glAccum(GL_RETURN, 1);
  });
  // In steps of 1 / 32767, from the colours' bytes.
  const auto expected = [](int byte) { return 255 * (byte / 255.0 * 0.375 + 0.125); };
  expect_level(level, {expected(64), expected(128), expected(255), expected(255)}, 0.02);
}

TEST_F(Oracle, DiamondsDecideOverLines) {
  open(8, 8);
  glBegin(GL_LINES);
  glVertex2d(1.5, 2.5), glVertex2d(4.5, 2.5);       // from centre to centre: the last one is not drawn
  glVertex2d(1.25, 5.875), glVertex2d(1.5, 5.875);  // leaves no diamond
  glEnd();
  const TrueFrame frame = shown();
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      EXPECT_EQ(frame.at(x, y).owner != 0, y == 2 && x >= 1 && x <= 3) << x << " " << y;
}

TEST_F(Oracle, ALoopDrawsEachOfItsPixelsOnce) {
  open(16, 16);
  glEnable(GL_COLOR_LOGIC_OP);
  glLogicOp(GL_XOR);
  glColor4ub(255, 255, 255, 255);
  glBegin(GL_LINE_LOOP);
  glVertex2d(2.5, 3.5), glVertex2d(13.5, 3.5), glVertex2d(8.5, 13.5);
  glEnd();
  const TrueFrame frame = shown();
  for (const TruePixel& pixel : frame.pixels) EXPECT_EQ(pixel.level[0] > 0, pixel.owner != 0);
  EXPECT_EQ(count(frame), 11 + 10 + 10);  // the longer way of each side, in whole pixels
}

TEST_F(Oracle, PointsAreSquares) {
  const struct {
    float size;
    double at;
    int x0, x1;
  } cases[] = {{1, 4.9, 4, 5}, {3, 4.9, 3, 6}, {2, 4.9, 4, 6}, {2, 4.2, 3, 5}, {2.6f, 4.2, 3, 6}};
  for (const auto& c : cases) {
    open(10, 10);
    glPointSize(c.size);
    glBegin(GL_POINTS);
    glVertex2d(c.at, c.at);
    glEnd();
    const TrueFrame frame = shown();
    for (int y = 0; y < 10; ++y)
      for (int x = 0; x < 10; ++x)
        EXPECT_EQ(frame.at(x, y).owner != 0, x >= c.x0 && x < c.x1 && y >= c.x0 && y < c.x1) << c.size;
  }
}

// Alpha is the area: the sum over all pixels is the shape's own.
TEST_F(Oracle, SmoothShapesCoverTheirArea) {
  const auto covered = [this](auto draw) {
    open(32, 32);
    draw();
    double sum = 0;
    for (const TruePixel& pixel : shown().pixels) sum += static_cast<double>(pixel.level[3]) / 255;
    return sum;
  };
  EXPECT_NEAR(covered([] {
                glEnable(GL_POINT_SMOOTH);
                glPointSize(9.5f);
                glBegin(GL_POINTS), glVertex2d(15.25, 16.75), glEnd();
              }),
              kPi * 4.75 * 4.75, 1e-4);
  EXPECT_NEAR(covered([] {
                glEnable(GL_LINE_SMOOTH);
                glLineWidth(2.5f);
                glBegin(GL_LINES), glVertex2d(5, 6), glVertex2d(5 + 12, 6 + 5), glEnd();
              }),
              13 * 2.5, 1e-4);
  EXPECT_NEAR(covered([] {
                glEnable(GL_POLYGON_SMOOTH);
                glBegin(GL_TRIANGLES), glVertex2d(3.25, 2), glVertex2d(28, 9.5), glVertex2d(11, 30), glEnd();
              }),
              0.5 * (24.75 * 28 - 7.75 * 7.5), 1e-4);
}

TEST_F(Oracle, StencilCountsAndUserPlanesCut) {
  open(8, 8);
  glEnable(GL_STENCIL_TEST);
  glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  fill(0, 0, 8, 8);
  const double plane[4] = {1, 1, 0, -7.75};  // x + y >= 7.75
  glClipPlane(GL_CLIP_PLANE2, plane);
  glEnable(GL_CLIP_PLANE2);
  fill(0, 0, 8, 8);
  glDisable(GL_CLIP_PLANE2);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glStencilFunc(GL_EQUAL, 2, 255);
  fill(0, 0, 8, 8);
  const TrueFrame frame = shown();
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) EXPECT_EQ(frame.at(x, y).level[0] > 0, x + y + 1 >= 7.75) << x << " " << y;
}

// An edge that passes 1/2048 px to the left of pixel centres is snapped onto them, and owns them as a right
// edge does not.
TEST_F(Oracle, CoverageOfCornersAsTheyAre) {
  for (const bool snapped : {true, false}) {
    setenv("HALFSPACE_TRUTH_POSITIONS", snapped ? "snapped" : "unsnapped", 1);
    open(8, 8);
    unsetenv("HALFSPACE_TRUTH_POSITIONS");
    fill(2.5 + 1.0 / 2048, 0, 8, 8);
    const TrueFrame frame = shown();
    EXPECT_EQ(frame.at(2, 4).owner != 0, snapped);
    EXPECT_NE(frame.at(3, 4).owner, 0u);
  }
}

// The window cuts a corner off this triangle's square: five corners are left, and their area.
TEST_F(Oracle, FeedbackReportsWhatClippingLeaves) {
  open(8, 8);
  float values[64] = {};
  glFeedbackBuffer(64, GL_3D_COLOR, values);
  glRenderMode(GL_FEEDBACK);
  glBegin(GL_TRIANGLES);
  glColor3d(0, 0.5, 1);
  glVertex3d(0, 0, 0.5), glVertex3d(12, 0, 0.5), glVertex3d(0, 12, 0.5);
  glVertex3d(9, 9, 0), glVertex3d(12, 9, 0), glVertex3d(9, 12, 0);  // outside
  glEnd();
  ASSERT_EQ(glRenderMode(GL_RENDER), 2 + 5 * 7);
  EXPECT_EQ(values[0], static_cast<float>(GL_POLYGON_TOKEN));
  ASSERT_EQ(values[1], 5);
  double twice_area = 0;
  for (int i = 0; i < 5; ++i) {
    const float *a = values + 2 + 7 * i, *b = values + 2 + 7 * ((i + 1) % 5);
    twice_area += static_cast<double>(a[0]) * static_cast<double>(b[1]) -
                  static_cast<double>(b[0]) * static_cast<double>(a[1]);
    EXPECT_FLOAT_EQ(a[2], 0.75f);
    EXPECT_FLOAT_EQ(a[4], 0.5f);
  }
  EXPECT_NEAR(twice_area / 2, 64 - 4 * 4 / 2.0, 1e-5);
}

TEST_F(Oracle, OwnersAreNumbersOfPrimitives) {
  open(8, 2);
  glBegin(GL_TRIANGLE_STRIP);  // 1, 2
  glVertex2d(0, 0), glVertex2d(0, 2), glVertex2d(2, 0), glVertex2d(2, 2);
  glEnd();
  fill(2, 0, 4, 2);  // 3
  glRectd(6, 0, 8, 2);
  const TrueFrame frame = shown();
  EXPECT_EQ(frame.at(0, 0).owner, 1u);
  EXPECT_EQ(frame.at(1, 1).owner, 2u);
  EXPECT_EQ(frame.at(3, 1).owner, 3u);
  EXPECT_EQ(frame.at(5, 1).owner, 0u);
  EXPECT_EQ(frame.at(7, 1).owner, 4u);
}

}  // namespace
}  // namespace halfspace::differential
