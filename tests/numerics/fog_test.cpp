// Fog against its definition in long double (spec 3.10).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "tests/support/canvas.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 128;

long double factor(const FogState& fog, long double distance) {
  const auto density = (long double)(fog.density), start = (long double)(fog.start), end = (long double)(fog.end);
  switch (fog.mode) {
    case FogMode::linear:
      return std::fmin(std::fmax((end - distance) / (end - start), 0.0L), 1.0L);
    case FogMode::exp:
      return std::exp(-density * distance);
    case FogMode::exp2:
      break;
  }
  return std::exp(-density * distance * density * distance);
}

// Object and eye coordinates are one; the clip volume is deep enough for every z here.
DrawState foggy_state(const FogState& fog) {
  DrawState state = plain_state(kSize, kSize);
  state.clip_from_object[10] = 1.0 / 4096;
  state.fog = fog;
  return state;
}

std::vector<Vertex> square(float z_left, float z_right, const Color& color) {
  return {{-1, -1, z_left, 1, color},
          {1, -1, z_right, 1, color},
          {1, 1, z_right, 1, color},
          {-1, 1, z_left, 1, color}};
}

std::vector<FogState> fogs() {
  return {{true, FogMode::linear, {0.1f, 0.6f, 0.9f, 0.2f}, 1, 5, 90},
          {true, FogMode::linear, {1, 0, 0.5f, 0}, 1, 90, 5},  // thins out with distance
          {true, FogMode::exp, {0.1f, 0.6f, 0.9f, 0.2f}, 0.04f, 0, 1},
          {true, FogMode::exp2, {0.7f, 0.2f, 0, 0}, 0.03f, 0, 1}};
}

// The share of the fragment's own colour, over distances from none to where nothing is left of it.
TEST(Fog, FactorIsWithinTenToTheMinusFive) {
  Canvas canvas(kSize, kSize, 1, ColorFormat::rgba32f);
  for (FogState fog : fogs()) {
    fog.color = {0, 0, 0, 0};
    for (int i = 0; i < (long_tests() ? 20000 : 600); ++i) {
      const float distance = i < 200 ? float(i) / 16 : float(i) / 4;
      canvas.draw(foggy_state(fog), Primitive::quads, square(-distance, -distance, {1, 1, 1, 0.5f}));
      float pixel[4];
      canvas.device().read_color_float({70, 50, 71, 51}, pixel);
      ASSERT_NEAR(double(pixel[0]), double(factor(fog, (long double)(distance))), 1e-5)
          << int(fog.mode) << distance;
      ASSERT_EQ(pixel[3], 0.5f);  // alpha is no colour of the fog's
    }
  }
}

TEST(Fog, EndsAreExact) {
  Canvas canvas(kSize, kSize);
  for (const FogState& fog : fogs()) {
    const Color own{0.3f, 0.8f, 0.55f, 1};
    DrawState clear_air = foggy_state(fog);
    clear_air.fog.enabled = false;
    const bool thins = fog.mode == FogMode::linear && fog.end < fog.start;
    const auto drawn = [&](const DrawState& state, float z, const Color& color) {
      canvas.draw(state, Primitive::quads, square(z, z, color));
      return canvas.read().rgba;
    };
    const auto without = drawn(clear_air, 0, own);
    EXPECT_EQ(drawn(foggy_state(fog), thins ? -90 : 0, own), without);
    const Color gray{fog.color.r, fog.color.g, fog.color.b, own.a};
    EXPECT_EQ(drawn(foggy_state(fog), thins ? -5 : -2000, own), drawn(clear_air, 0, gray));
    // In front of the eye or behind: the distance has no sign.
    EXPECT_EQ(drawn(foggy_state(fog), 17, own), drawn(foggy_state(fog), -17, own));
  }
}

// Pixels of a slanted square. A level may be off by what interpolation and the factor may be off, no more.
constexpr double kSlack = 0.5 + 2.0 / 64 + 255e-5;

void check(const Picture& picture, const FogState& fog, const Color& own,
           const std::function<long double(int)>& depth) {
  const float c[3] = {own.r, own.g, own.b}, f[3] = {fog.color.r, fog.color.g, fog.color.b};
  for (int x = 0; x < kSize; ++x) {
    const long double share = factor(fog, depth(x));
    for (int k = 0; k < 3; ++k) {
      const long double exact = (share * (long double)(c[k]) + (1 - share) * (long double)(f[k])) * 255;
      ASSERT_NEAR(double(picture.pixel(x, 77)[k]), double(exact), kSlack) << int(fog.mode) << " at " << x;
    }
  }
}

TEST(Fog, IsComputedAtEachFragment) {
  for (const std::string& isa : isa_levels()) {
    const IsaScope scope(isa);
    for (const FogState& fog : fogs()) {
      Canvas canvas(kSize, kSize, 2);
      const Color own{0.9f, 0.3f, 0.2f, 1};
      canvas.draw(foggy_state(fog), Primitive::quads, square(-2, -130, own));
      ASSERT_NO_FATAL_FAILURE(check(canvas.read(), fog, own, [](int x) {
        return 2 + 128 * ((long double)(x) + 0.5L) / kSize;
      })) << isa;
    }
  }
}

// A wall that runs away from the eye: z = a / (1 + b X) at window coordinate X in [-1, 1].
TEST(Fog, IsRightInPerspective) {
  for (const FogState& fog : fogs()) {
    Canvas canvas(kSize, kSize, 2);
    DrawState state = foggy_state(fog);
    state.clip_from_object = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1.0 / 4096, -1, 0, 0, 0, 0};
    const double a = -6, b = -0.9;
    const auto corner = [&](double ndc_x, double ndc_y) {
      const double z = a / (1 + b * ndc_x);
      Vertex v{float(-ndc_x * z), float(-ndc_y * z), float(z), 1, {0.9f, 0.3f, 0.2f, 1}};
      return v;
    };
    const std::array<Vertex, 4> wall{corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
    canvas.draw(state, Primitive::quads, wall);
    ASSERT_NO_FATAL_FAILURE(check(canvas.read(), fog, wall[0].color, [&](int x) {
      const long double ndc = ((long double)(x) + 0.5L) / (kSize / 2) - 1;
      return std::fabs((long double)(a) / (1 + (long double)(b) * ndc));
    }));
  }
}

// The same bytes at every level of code, fused or not, with and without depth and texture before it.
TEST(Fog, IsTheSameEverywhere) {
  for (const FogState& fog : fogs()) {
    std::vector<uint8_t> first;
    for (const std::string& isa : isa_levels()) {
      const IsaScope scope(isa);
      for (const bool fuse : {true, false}) {
        Canvas canvas(kSize, kSize, 2, ColorFormat::rgba8, fuse);
        DrawState state = foggy_state(fog);
        state.depth = {true, CompareFunc::less, true};
        for (int i = 0; i < 300; ++i) {  // small ones, which are packed, too
          const float x = float(i % 20) / 10 - 1, y = float(i / 20) / 8 - 1, size = i % 3 == 0 ? 0.4f : 0.07f;
          const std::array<Vertex, 3> corners{{{x, y, -float(i % 50), 1, {1, 0.5f, 0, 1}},
                                               {x + size, y, -20, 1, {0, 1, 0.25f, 1}},
                                               {x, y + size, -float(i % 9), 1, {0.5f, 0.5f, 1, 1}}}};
          canvas.draw(state, Primitive::triangles, corners);
        }
        const auto rgba = canvas.read().rgba;
        if (first.empty()) first = rgba;
        ASSERT_EQ(rgba, first) << isa << fuse;
      }
    }
  }
}

// Values no fog should have do no harm.
TEST(Fog, OddValuesAreDefined) {
  Canvas canvas(kSize, kSize);
  const float odd[] = {0, -1, 1e30f, -1e30f, INFINITY, -INFINITY, NAN};
  for (const FogMode mode : {FogMode::linear, FogMode::exp, FogMode::exp2}) {
    for (const float a : odd) {
      for (const float b : odd) {
        const FogState fog{true, mode, {1, 0, 0.5f, 0}, a, a, b};
        canvas.draw(foggy_state(fog), Primitive::quads, square(-2, -130, {1, 1, 1, 1}));
        canvas.read();
      }
    }
  }
}

}  // namespace
}  // namespace halfspace::test
