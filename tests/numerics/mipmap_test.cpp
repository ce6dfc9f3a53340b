// Which level of detail, to 1/64 level (spec 3.8.8).
#include <gtest/gtest.h>

#include "tests/oracle/triangle.h"
#include "tests/support/canvas.h"
#include "tests/support/textures.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 96, kViewport = 128;
constexpr int kTexture = 256, kLevels = 9;
constexpr double kLodTolerance = 1.0 / 64;

// Even levels black, odd ones white: between two levels a pixel's byte is the fraction of lambda, to 1/255
// level.
TestTexture alternating_levels() {
  TestTexture texture;
  for (int level = 0; level < kLevels; ++level) {
    const uint8_t value = level % 2 ? 255 : 0, color[4] = {value, value, value, value};
    texture.add_color(kTexture >> level, kTexture >> level, color);
  }
  return texture;
}

// Level k has the gray 28 k.
TestTexture rising_levels() {
  TestTexture texture;
  for (int level = 0; level < kLevels; ++level) {
    const uint8_t value = uint8_t(28 * level), color[4] = {value, value, value, value};
    texture.add_color(kTexture >> level, kTexture >> level, color);
  }
  return texture;
}

DrawState state_of(TestTexture& texture, const Sampler& sampler) {
  DrawState state = plain_state(kViewport, kViewport);
  state.texture.view = texture.view(sampler);
  state.texture.env = EnvMode::replace;
  return state;
}

Sampler mip_sampler(Filter min, MipMode mip, Filter mag = Filter::linear) {
  Sampler sampler = sampler_of(min, Wrap::repeat, mip);
  sampler.mag = mag;
  return sampler;
}

struct Textured {
  std::vector<Vertex> vertices;
  std::array<long double, 3> s, t, q;
  oracle::Triangle triangle;
};

Textured random_triangle(Random& random, const Viewport& viewport, bool projective) {
  std::vector<Vertex> v(3);
  std::array<oracle::ClipPoint, 3> clip;
  std::array<long double, 3> s, t, q;
  // rho from well below one texel a pixel to far beyond the last level.
  const float scale = float(int64_t{1} << random.integer(0, 9)) / 8;
  for (size_t i = 0; i < 3; ++i) {
    v[i].w = random.real(0.5f, 12);
    v[i].x = v[i].w * random.real(-1.5f, 1.5f);
    v[i].y = v[i].w * random.real(-1.5f, 1.5f);
    v[i].s = random.real(-scale, scale);
    v[i].t = random.real(-scale, scale);
    v[i].q = projective ? random.real(0.5f, 2) : 1;
    clip[i] = {double(v[i].x), double(v[i].y), 0, double(v[i].w)};
    s[i] = static_cast<long double>(v[i].s);
    t[i] = static_cast<long double>(v[i].t);
    q[i] = static_cast<long double>(v[i].q);
  }
  return {v, s, t, q, oracle::Triangle(viewport, clip)};
}

// Calls check(picture, x, y, exact) for the pixels of random textured triangles.
template <typename Check>
void for_random_triangles(TestTexture& texture, const Sampler& sampler, uint64_t seed, const Check& check) {
  Random random(seed);
  const oracle::Texture reference = texture.reference(sampler);
  const DrawState state = state_of(texture, sampler);
  for (int round = 0; round < (long_tests() ? 1000 : 60); ++round) {
    const Textured textured = random_triangle(random, state.viewport, round % 4 == 3);
    Canvas canvas(kSize, kSize);
    canvas.draw(state, Primitive::triangles, textured.vertices);
    const Picture picture = canvas.read();
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        if (!textured.triangle.covers(x, y)) continue;
        const auto s = textured.triangle.projected(textured.s, textured.q, x, y);
        const auto t = textured.triangle.projected(textured.t, textured.q, x, y);
        check(picture, x, y, oracle::sample(reference, s, t));
        if (testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

TEST(Mipmap, LambdaWithinASixtyFourth) {
  TestTexture texture = alternating_levels();
  double worst = 0;
  for_random_triangles(texture, mip_sampler(Filter::linear, MipMode::linear), 1,
                       [&](const Picture& picture, int x, int y, const oracle::Lookup& exact) {
                         const double error =
                             std::fabs(picture.pixel(x, y)[0] / 255.0 - double(exact.color[0]));
                         worst = std::max(worst, error);
                         ASSERT_LE(error, kLodTolerance + 0.55 / 255)
                             << "pixel " << x << ", " << y << ": lambda " << double(exact.lod) << ", byte "
                             << int(picture.pixel(x, y)[0]) << ", exact " << double(exact.color[0] * 255);
                       });
  RecordProperty("worst_lambda_error", std::to_string(worst));
}

TEST(Mipmap, NearestLevel) {
  TestTexture texture = rising_levels();
  for (Filter filter : {Filter::nearest, Filter::linear}) {
    for (Filter mag : {Filter::nearest, Filter::linear}) {
      for_random_triangles(texture, mip_sampler(filter, MipMode::nearest, mag), 2,
                           [&](const Picture& picture, int x, int y, const oracle::Lookup& exact) {
                             // Within 1/64 of the half between two levels either will do.
                             const double lod = double(exact.lod), half = std::floor(lod) + 0.5;
                             if (std::fabs(lod - half) < kLodTolerance) return;
                             ASSERT_EQ(int(picture.pixel(x, y)[0]), std::lround(exact.color[0] * 255))
                                 << "lambda " << lod << ", pixel " << x << ", " << y;
                           });
    }
  }
}

// Spec 3.8.9: lambda = c is magnification; c is 1/2 only for LINEAR with NEAREST_MIPMAP_*. Level 0 and the
// other levels differ, and so do the two filters on the checkered level 0.
TEST(Mipmap, MagnificationSwitchesAtC) {
  std::vector<uint8_t> checks;
  for (int i = 0; i < 64 * 64; ++i) checks.insert(checks.end(), 4, uint8_t((i + i / 64) % 2 ? 240 : 80));
  TestTexture texture;
  texture.add_level(64, 64, 0, checks);
  const uint8_t black[4] = {0, 0, 0, 0};
  for (int size = 32; size > 0; size /= 2) texture.add_color(size, size, black);
  for (Filter mag : {Filter::nearest, Filter::linear}) {
    for (Filter min : {Filter::nearest, Filter::linear}) {
      for (MipMode mip : {MipMode::nearest, MipMode::linear}) {
        const Sampler sampler = mip_sampler(min, mip, mag);
        const double c = mag == Filter::linear && min == Filter::nearest ? 0.5 : 0;
        for (double lod : {c - 0.25, c - 0.05, c + 0.05, c + 0.25}) {
          const DrawState state = state_of(texture, sampler);
          std::vector<Vertex> quad = snapped_quad(0, 0, 64 * 256, 64 * 256, kViewport);
          quad[1].s = quad[2].s = quad[2].t = quad[3].t = float(std::exp2(lod));
          std::array<oracle::ClipPoint, 3> clip;
          std::array<long double, 3> s, t;
          for (size_t i = 0; i < 3; ++i) {
            clip[i] = {double(quad[i].x), double(quad[i].y), 0, 1};
            s[i] = static_cast<long double>(quad[i].s), t[i] = static_cast<long double>(quad[i].t);
          }
          const oracle::Triangle triangle(state.viewport, clip);
          Canvas canvas(64, 64);
          canvas.draw(state, Primitive::quads, quad);
          const Picture picture = canvas.read();
          for (int i = 1; i < 63; ++i) {
            // Along a row of the triangle (0, 1, 2).
            const int x = i, y = 1;
            if (!triangle.covers(x, y)) continue;
            const oracle::Lookup exact = oracle::sample(
                texture.reference(sampler), triangle.attribute(s, x, y), triangle.attribute(t, x, y));
            ASSERT_EQ(exact.magnified, lod <= c);
            const bool mixes = !exact.magnified && mip == MipMode::linear;
            // Nearest lookups may fall on a texel's edge.
            const double u = double(triangle.attribute(s, x, y).value) * 64,
                         v = double(triangle.attribute(t, x, y).value) * 64;
            if (std::fabs(u - std::round(u)) < 0.01 || std::fabs(v - std::round(v)) < 0.01) continue;
            ASSERT_LE(std::fabs(picture.pixel(x, y)[0] - double(exact.color[0] * 255)),
                      mixes ? 240 * kLodTolerance + 0.55 : 0.55)
                << "mag " << int(mag) << ", min " << int(min) << ", mip " << int(mip) << ", lambda " << lod
                << ", pixel " << x;
          }
        }
      }
    }
  }
}

// rho an exact power of two: lambda is an integer, and one level alone is seen.
TEST(Mipmap, PowersOfTwoAreExact) {
  TestTexture texture = rising_levels();
  for (int k = 0; k < kLevels + 2; ++k) {
    for (bool turned : {false, true}) {
      const DrawState state = state_of(texture, mip_sampler(Filter::linear, MipMode::linear));
      // 2^k texels a pixel over 64 px.
      const float repeats = float(1 << k) * 64 / kTexture;
      std::vector<Vertex> quad = snapped_quad(0, 0, 64 * 256, 64 * 256, kViewport);
      for (size_t i = 0; i < 4; ++i) {
        const float x = i == 1 || i == 2 ? repeats : 0, y = i > 1 ? repeats : 0;
        quad[i].s = turned ? y : x;
        quad[i].t = turned ? -x : y;
      }
      Canvas canvas(64, 64);
      canvas.draw(state, Primitive::quads, quad);
      const Picture picture = canvas.read();
      for (size_t i = 0; i < picture.rgba.size(); ++i) {
        ASSERT_EQ(int(picture.rgba[i]), 28 * std::min(k, kLevels - 1)) << "2^" << k << " texels a pixel";
      }
    }
  }
}

// Along a floor that recedes, lambda never falls.
TEST(Mipmap, Monotonic) {
  TestTexture texture = rising_levels();
  for (float far_w : {4.0f, 60.0f, 1000.0f}) {
    const DrawState state = state_of(texture, mip_sampler(Filter::linear, MipMode::linear));
    std::vector<Vertex> quad = snapped_quad(0, 0, 90 * 256, 90 * 256, kViewport);
    for (size_t i = 2; i < 4; ++i) {
      quad[i].x *= far_w, quad[i].y *= far_w, quad[i].w = far_w;
      quad[i].t = far_w;
    }
    quad[1].s = 1;
    quad[2].s = far_w;
    Canvas canvas(kSize, kSize);
    canvas.draw(state, Primitive::quads, quad);
    const Picture picture = canvas.read();
    for (int x = 1; x < 88; ++x) {
      for (int y = 1; y < 89; ++y) {
        // The quad's two triangles have planes of their own: their derivatives agree to rounding only.
        ASSERT_GE(int(picture.pixel(x, y)[0]), int(picture.pixel(x, y - 1)[0]))
            << far_w << ": " << x << ", " << y;
      }
    }
  }
}

}  // namespace
}  // namespace halfspace::test
