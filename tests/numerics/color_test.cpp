// Colours: bytes come back, gradients round to nearest, flat shading takes the provoking vertex.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/oracle/fragment.h"
#include "tests/oracle/triangle.h"
#include "tests/support/canvas.h"
#include "tests/support/random.h"
#include "tests/support/textures.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 64;

Color gray(int byte) {
  const float c = float(byte) / 255;
  return {c, c, c, c};
}

// As one colour for all vertices, as a colour that happens to be the same at every vertex, on every accuracy.
TEST(Color, EveryByteComesBack) {
  for (Level level : {Level::draft, Level::standard, Level::exact}) {
    Canvas canvas(kSize, kSize);
    DrawState state = plain_state(kSize, kSize);
    state.accuracy = Accuracy::all(level);
    for (int byte = 0; byte < 256; ++byte) {
      const std::vector<Vertex> quad =
          snapped_quad(-900, 33, 80 * 256, 70 * 256 + 1, kSize, 0.3f, gray(byte));
      canvas.draw_plain(state, Primitive::quads, quad, gray(byte));
      Picture picture = canvas.read();
      for (size_t i = 0; i < picture.rgba.size(); ++i) ASSERT_EQ(int(picture.rgba[i]), byte);
      canvas.clear();
      // A second triangle of another colour keeps the batch's colour from being one for all.
      std::vector<Vertex> two(quad.begin(), quad.begin() + 3);
      two.insert(two.end(), {quad[2], quad[3], quad[0]});
      for (size_t i = 3; i < 6; ++i) two[i].color = gray(255 - byte);
      // In perspective too: a constant attribute stays exactly constant.
      for (size_t i = 0; i < 6; ++i) {
        const float w = float(1 << (i % 3));
        two[i].x *= w, two[i].y *= w, two[i].z *= w, two[i].w = w;
      }
      canvas.draw(state, Primitive::triangles, two);
      picture = canvas.read();
      for (size_t i = 0; i < picture.rgba.size(); ++i) {
        ASSERT_TRUE(picture.rgba[i] == byte || picture.rgba[i] == 255 - byte)
            << "byte " << byte << " became " << int(picture.rgba[i]);
      }
    }
  }
}

// A pixel's centre may lie just outside the corners as they were before snapping. The colour is not carried on beyond its
// range there: what it is multiplied with afterwards would show it.
TEST(Color, NothingIsBrighterThanWhite) {
  Random random(77);
  TestTexture texture;
  texture.add_color(1, 1, (const uint8_t[]){128, 128, 128, 255});
  DrawState state = plain_state(kSize, kSize);
  state.texture.view = texture.view(sampler_of(Filter::nearest, Wrap::repeat));
  state.texture.env = EnvMode::modulate;
  std::vector<Vertex> triangles;
  for (int i = 0; i < 12000; ++i) {
    // Needles 3 to 6 sub-pixels wide, dark along one side; half of them in perspective.
    const auto real = [&random](float low, float high) { return double(random.real(low, high)); };
    const double x = real(-1, 1), y = real(-1, 1), angle = real(0, 6.25);
    const double along = 40.0 / kSize, across = real(3, 6) / 256 * 2 / kSize;
    const double dx = std::cos(angle), dy = std::sin(angle);
    const auto corner = [&](double u, double v, float bright) {
      const double w = i % 2 == 0 ? 1 : real(1, 1.25F);
      const auto px = float((x + u * dx - v * dy) * w), py = float((y + u * dy + v * dx) * w);
      triangles.push_back({px, py, 0, float(w), {bright, bright, bright, 1}});
    };
    corner(-along, 0, 0), corner(along, 0, 0), corner(0, across, 1);
  }
  Canvas canvas(kSize, kSize);
  canvas.draw(state, Primitive::triangles, triangles);
  const Picture picture = canvas.read();
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      for (int k = 0; k < 3; ++k) ASSERT_LE(int(picture.pixel(x, y)[k]), 128) << "at (" << x << ", " << y << ")";
}

TEST(Color, ClearRoundsToNearest) {
  Canvas canvas(3, 3);
  for (int byte = 0; byte < 256; ++byte) {
    canvas.clear(gray(byte));
    ASSERT_EQ(int(canvas.read().pixel(1, 1)[2]), byte);
    if (byte == 255) continue;
    canvas.clear({(float(byte) + 0.49f) / 255, (float(byte) + 0.51f) / 255, -1, 2});
    const Picture picture = canvas.read();
    ASSERT_EQ(int(picture.pixel(1, 1)[0]), byte);
    ASSERT_EQ(int(picture.pixel(1, 1)[1]), byte + 1);
    ASSERT_EQ(int(picture.pixel(1, 1)[2]), 0);
    ASSERT_EQ(int(picture.pixel(1, 1)[3]), 255);
  }
}

// The floats on either side of half a level, as a clear and as a draw's one colour.
TEST(Color, HalfLevelsRoundToTheNearerByte) {
  Canvas canvas(2, 2);
  const std::vector<Vertex> quad = snapped_quad(0, 0, 512, 512, 2);
  for (int byte = 0; byte < 255; ++byte) {
    const double half = (2 * byte + 1) / 510.0;
    float below = float(half), above = below;
    if (double(below) > half) below = std::nextafter(below, 0.0f);
    if (double(above) < half) above = std::nextafter(above, 1.0f);
    if (below == above) above = std::nextafter(above, 1.0f);
    for (int draw = 0; draw < 2; ++draw) {
      const auto show = [&](const Color& color) {
        draw ? canvas.draw_plain(plain_state(2, 2), Primitive::quads, quad, color) : canvas.clear(color);
        return canvas.read();
      };
      const Picture picture = show({below, above, below, above});
      // Exactly one half (byte 127) may go either way.
      if (double(below) < half) {
        EXPECT_EQ(int(picture.pixel(0, 1)[0]), byte) << "draw " << draw;
      }
      EXPECT_EQ(int(picture.pixel(0, 1)[1]), byte + 1) << "draw " << draw;
    }
  }
}

struct GradientOptions {
  Accuracy accuracy;
  bool perspective;
  double tolerance;  // levels; 1/2 is perfect rounding
};

void expect_gradients(const GradientOptions& options, uint64_t seed) {
  Random random(seed);
  DrawState state = plain_state(kSize, kSize);
  state.accuracy = options.accuracy;
  for (int round = 0; round < (long_tests() ? 500 : 30); ++round) {
    std::vector<Vertex> v(3);
    std::array<oracle::ClipPoint, 3> clip;
    for (size_t i = 0; i < 3; ++i) {
      v[i].w = options.perspective ? random.real(0.5f, 8) : 1;
      v[i].x = v[i].w * random.real(-2, 2);
      v[i].y = v[i].w * random.real(-2, 2);
      v[i].color.r = random.real(0, 1), v[i].color.g = random.real(0, 1);
      v[i].color.b = random.real(0, 1), v[i].color.a = random.real(0, 1);
      clip[i] = {double(v[i].x), double(v[i].y), double(v[i].z), double(v[i].w)};
    }
    const oracle::Triangle triangle(state.viewport, clip);
    Canvas canvas(kSize, kSize);
    canvas.draw(state, Primitive::triangles, v);
    const Picture picture = canvas.read();
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        if (!triangle.covers(x, y)) continue;
        for (int c = 0; c < 4; ++c) {
          std::array<long double, 3> values;
          for (size_t i = 0; i < 3; ++i) values[i] = static_cast<long double>((&v[i].color.r)[c]);
          const long double exact = oracle::level_of(triangle.attribute(values, x, y).value);
          ASSERT_LE(std::fabs(double(exact) - picture.pixel(x, y)[c]), options.tolerance)
              << "triangle " << round << ", pixel " << x << ", " << y << ", component " << c << ": exact "
              << double(exact) << ", is " << int(picture.pixel(x, y)[c]);
        }
      }
    }
  }
}

TEST(Color, GradientsRoundToNearest) { expect_gradients({Accuracy::all(Level::standard), false, 0.501}, 1); }
TEST(Color, PerspectiveGradientsRoundToNearest) { expect_gradients({Accuracy::all(Level::standard), true, 0.501}, 2); }
TEST(Color, ExactGradientsRoundToNearest) {
  // Interpolated in double; the last steps, in float, may cost a float's spacing at 255.
  expect_gradients({Accuracy::all(Level::exact), true, 0.5 + 0x1p-15}, 3);
}

// Spec 2.14.7, table 2.12: which vertex colours the i-th polygon or line of a flat-shaded primitive.
TEST(FlatShading, ProvokingVertex) {
  // 0-based index of the provoking vertex of primitive i.
  struct Case {
    Primitive primitive;
    int (*provoking)(int i);
  };
  const Case cases[] = {
      {Primitive::triangles, [](int i) { return 3 * i + 2; }},
      {Primitive::triangle_strip, [](int i) { return i + 2; }},
      {Primitive::triangle_fan, [](int i) { return i + 2; }},
      {Primitive::quads, [](int i) { return 4 * i + 3; }},
      {Primitive::quad_strip, [](int i) { return 2 * i + 3; }},
      {Primitive::polygon, [](int) { return 0; }},
      {Primitive::lines, [](int i) { return 2 * i + 1; }},
      {Primitive::line_strip, [](int i) { return i + 1; }},
      {Primitive::line_loop, [](int i) { return i == 11 ? 0 : i + 1; }},
  };
  constexpr int kVertices = 12;
  for (const Case& c : cases) {
    // A wheel of vertices around the middle; strips go back and forth between two rings.
    std::vector<Vertex> v;
    const bool strip = c.primitive == Primitive::triangle_strip || c.primitive == Primitive::quad_strip;
    static constexpr int kCircle[12][2] = {{8, 0},  {7, 4},   {4, 7},   {0, 8},  {-4, 7}, {-7, 4},
                                           {-8, 0}, {-7, -4}, {-4, -7}, {0, -8}, {4, -7}, {7, -4}};
    for (int i = 0; i < kVertices; ++i) {
      const int64_t x = strip ? (i / 2) * 10 * 256 + 256 : (32 + 3 * kCircle[i][0]) * 256;
      const int64_t y = strip ? (i % 2 ? 60 : 4) * 256 : (32 + 3 * kCircle[i][1]) * 256;
      v.push_back(snapped_vertex(x, y, kSize, 0, gray(20 * i + 10)));
    }
    Canvas canvas(kSize, kSize);
    DrawState state = plain_state(kSize, kSize);
    state.raster.flat_shading = true;
    canvas.draw(state, c.primitive, v);
    std::vector<bool> seen(256), allowed(256);
    const Picture picture = canvas.read();
    for (size_t i = 0; i < picture.rgba.size(); i += 4) seen[picture.rgba[i]] = true;
    seen[0] = false;
    int primitives = 0;
    switch (c.primitive) {
      case Primitive::triangles:
        primitives = kVertices / 3;
        break;
      case Primitive::quads:
        primitives = kVertices / 4;
        break;
      case Primitive::lines:
        primitives = kVertices / 2;
        break;
      case Primitive::quad_strip:
        primitives = kVertices / 2 - 1;
        break;
      case Primitive::line_strip:
        primitives = kVertices - 1;
        break;
      case Primitive::line_loop:
        primitives = kVertices;
        break;
      case Primitive::polygon:
        primitives = 1;
        break;
      default:
        primitives = kVertices - 2;
        break;
    }
    for (int i = 0; i < primitives; ++i) allowed[size_t(20 * c.provoking(i) + 10)] = true;
    EXPECT_EQ(seen, allowed) << "primitive " << int(c.primitive);
  }
}

}  // namespace
}  // namespace halfspace::test
