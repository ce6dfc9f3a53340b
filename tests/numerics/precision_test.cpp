// Precision on demand: where planes in float are chosen, they are as near as docs/numerics.md derives,
// whatever the primitive. The truth is a 64-bit mantissa's.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/oracle/triangle.h"
#include "tests/support/canvas.h"
#include "tests/support/random.h"
#include "tests/support/textures.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 64;
// What the choice guarantees, in parts of its tolerance: four roundings where it counts three, and 1/w nearly
// right.
constexpr double kGuarantee = 4.0 / 3 * 1.01;
constexpr double kColorBound = kGuarantee / 64;    // levels
constexpr double kTexelBound = kGuarantee / 1024;  // texels
constexpr double kSlack = 4e-5;                    // levels: a float target's own roundings

struct Primitive3 {
  std::vector<Vertex> vertices = std::vector<Vertex>(3);
  std::array<oracle::ClipPoint, 3> clip;
  int step = 3;  // from one pixel that is looked at to the next
};

// Of all sizes and tilts: a few pixels or the whole guard band, w constant, or in ratios up to 10^6.
Primitive3 random_primitive(Random& random) {
  Primitive3 p;
  const int kind = int(random.integer(0, 5));
  const float reach = kind < 2 ? float(std::pow(2.0, double(random.real(-5, 0)))) : 1;
  const float center_x = random.real(-1, 1) * (1 - reach) * 0.9f,
              center_y = random.real(-1, 1) * (1 - reach) * 0.9f;
  const float decades = kind == 0 ? 0 : kind == 5 ? 6.0f : random.real(0, 3);
  // Sometimes all of it far away or near, to the ends of what a float holds.
  const float scale = random.integer(0, 19) == 0 ? float(std::pow(10.0, double(random.real(-25, 30)))) : 1;
  for (size_t i = 0; i < 3; ++i) {
    Vertex& v = p.vertices[i];
    v.w = scale * float(std::pow(10.0, double(random.real(0, 1) * decades)));
    v.x = v.w * (center_x + random.real(-1, 1) * reach);
    v.y = v.w * (center_y + random.real(-1, 1) * reach);
    v.z = 0;
    p.clip[i] = {double(v.x), double(v.y), 0, double(v.w)};
  }
  return p;
}

// Long and thin, with slopes so great that what they add up to over the length leaves few of a float's bits:
// here the colours' own bound has to choose, since 1/w is near enough. Of which side the third corner lies is
// left to chance.
Primitive3 random_sliver(Random& random) {
  Primitive3 p;
  p.step = 1;
  const float angle = random.real(0, 6.28f), length = float(std::pow(2.0, double(random.real(-6, 0))));
  const float along_x = std::cos(angle) * length, along_y = std::sin(angle) * length;
  const float thin = random.real(-1, 1) * float(std::pow(10.0, double(random.real(-4, -1))));
  const float at = random.real(0.1f, 0.9f);
  const float x[3] = {-along_x, along_x, (2 * at - 1) * along_x - thin * along_y};
  const float y[3] = {-along_y, along_y, (2 * at - 1) * along_y + thin * along_x};
  const float decades = random.integer(0, 1) == 0 ? 0 : random.real(0, 1);
  for (size_t i = 0; i < 3; ++i) {
    Vertex& v = p.vertices[i];
    v.w = float(std::pow(10.0, double(random.real(0, 1) * decades)));
    v.x = v.w * x[i];
    v.y = v.w * y[i];
    v.z = 0;
    p.clip[i] = {double(v.x), double(v.y), 0, double(v.w)};
  }
  return p;
}

// Calls check(x, y) for pixels the triangle covers, every `step`-th of a window of kSize pixels around its
// middle.
template <typename Check>
void for_covered(const oracle::Triangle& triangle, const Rect& window, int step, const Check& check) {
  for (int y = window.y0; y < window.y1; y += step) {
    for (int x = window.x0; x < window.x1; x += step) {
      if (triangle.covers(x, y)) check(x, y);
    }
  }
}

struct Count {
  uint64_t primitives = 0, pixels = 0, in_double = 0;
  double worst = 0;
};

using MakePrimitive = Primitive3 (*)(Random&);

// `dark`: colours of a few levels at most, where the bound of 1/w alone decides.
Count compare_colors(uint64_t seed, int count, int viewport, bool dark, MakePrimitive make) {
  Random random(seed);
  Count result;
  Canvas canvas(kSize, kSize, 1, ColorFormat::rgba32f);
  std::vector<float> pixels(kSize * kSize * 4);
  for (int n = 0; n < count; ++n) {
    Primitive3 p = make(random);
    for (Vertex& v : p.vertices) {
      const float most = dark ? float(std::pow(10.0, double(random.real(-7, -1)))) : 1;
      v.color = {random.real(0, most), random.real(0, most), random.real(0, most), random.real(0, most)};
    }
    // The window shows a part of the viewport: some of the triangle, most often.
    DrawState state = plain_state(viewport, viewport);
    const double px = double(p.vertices[0].x / p.vertices[0].w + p.vertices[1].x / p.vertices[1].w) / 2;
    const double py = double(p.vertices[0].y / p.vertices[0].w + p.vertices[2].y / p.vertices[2].w) / 2;
    state.viewport.x = kSize / 2 - int((px + 1) * viewport / 2);
    state.viewport.y = kSize / 2 - int((py + 1) * viewport / 2);
    const oracle::Triangle triangle(state.viewport, p.clip);
    const uint64_t before = canvas.device().statistics().double_fragments;
    canvas.clear();
    canvas.draw(state, Primitive::triangles, p.vertices);
    canvas.device().read_color_float({0, 0, kSize, kSize}, pixels.data());
    if (canvas.device().statistics().double_fragments != before) ++result.in_double;
    ++result.primitives;
    for_covered(triangle, {0, 0, kSize, kSize}, p.step, [&](int x, int y) {
      ++result.pixels;
      for (size_t k = 0; k < 4; ++k) {
        std::array<long double, 3> values;
        for (size_t i = 0; i < 3; ++i) {
          const Color& c = p.vertices[i].color;
          values[i] = (long double)(k == 0 ? c.r : k == 1 ? c.g : k == 2 ? c.b : c.a);
        }
        const auto truth = std::fmin(std::fmax(triangle.attribute(values, x, y).value, 0.0L), 1.0L) * 255;
        const double is = double(pixels[size_t(y * kSize + x) * 4 + k]) * 255;
        const double error = std::fabs(double((long double)(is)-truth));
        if (!(error <= result.worst)) result.worst = error;
      }
    });
  }
  return result;
}

int primitives() { return long_tests() ? 340000 : 1500; }

void expect_near_colors(MakePrimitive make, int count_of_each) {
  uint64_t floats = 0, doubles = 0, pixels = 0;
  double worst = 0;
  for (const int viewport : {64, 512, 8192}) {
    for (const bool dark : {false, true}) {
      const Count count = compare_colors(uint64_t(viewport) + dark, count_of_each, viewport, dark, make);
      EXPECT_LE(count.worst, kColorBound + kSlack) << "viewport " << viewport << (dark ? ", dark" : "");
      doubles += count.in_double, floats += count.primitives - count.in_double, pixels += count.pixels;
      worst = std::max(worst, count.worst);
    }
  }
  std::cout << floats << " primitives in float, " << doubles << " in double, " << pixels
            << " pixels compared; largest error " << worst << " levels of " << kColorBound << "\n";
  EXPECT_GT(floats, doubles / 10);
  EXPECT_GT(doubles, floats / 100);
}

TEST(PrecisionOnDemand, ColoursAreNeverFartherOffThanDerived) {
  expect_near_colors(random_primitive, primitives() / 3);
}

TEST(PrecisionOnDemand, ColoursOfSliversAreNeverFartherOffThanDerived) {
  expect_near_colors(random_sliver, primitives() / 6);
}

// Through a linear filter, where half a texel off is half the difference of two texels.
TEST(PrecisionOnDemand, CoordinatesAreNeverFartherOffThanDerived) {
  constexpr int kWidth = 8;
  Random random(77);
  TestTexture texture;
  texture.add_noise(random, kWidth, 1);
  const Sampler sampler = sampler_of(Filter::linear, Wrap::repeat);
  const oracle::Texture reference = texture.reference(sampler);
  const auto view = texture.view(sampler);
  Canvas canvas(kSize, kSize, 1, ColorFormat::rgba32f);
  std::vector<float> pixels(kSize * kSize * 4);
  uint64_t compared = 0, doubles = 0;
  double worst = 0;
  for (int n = 0; n < primitives(); ++n) {
    const int viewport = n % 3 == 0 ? 64 : n % 3 == 1 ? 512 : 8192;
    Primitive3 p = random_primitive(random);
    const float offset = float(std::ldexp(1.0, int(random.integer(0, 20)))),
                turns = float(std::pow(10.0, double(random.real(-2, 2))));
    for (Vertex& v : p.vertices) v.s = offset + random.real(0, turns), v.t = 0.5f;
    DrawState state = plain_state(viewport, viewport);
    state.texture.view = view;
    state.texture.env = EnvMode::replace;
    state.viewport.x = state.viewport.y = kSize / 2 - viewport / 2;
    const oracle::Triangle triangle(state.viewport, p.clip);
    const uint64_t before = canvas.device().statistics().double_fragments;
    canvas.clear();
    canvas.draw(state, Primitive::triangles, p.vertices);
    canvas.device().read_color_float({0, 0, kSize, kSize}, pixels.data());
    if (canvas.device().statistics().double_fragments != before) ++doubles;
    const std::array<long double, 3> s{(long double)(p.vertices[0].s), (long double)(p.vertices[1].s),
                                       (long double)(p.vertices[2].s)};
    for_covered(triangle, {0, 0, kSize, kSize}, p.step, [&](int x, int y) {
      ++compared;
      const auto at = triangle.attribute(s, x, y).value;
      const oracle::Rgba truth = oracle::sample_level(reference, 0, Filter::linear, at, 0.5L);
      for (size_t k = 0; k < 4; ++k) {
        const double is = double(pixels[size_t(y * kSize + x) * 4 + k]) * 255;
        const double error = std::fabs(double((long double)(is)-truth[k] * 255));
        if (!(error <= worst)) worst = error;
      }
    });
  }
  std::cout << doubles << " of " << primitives() << " primitives in double, " << compared
            << " pixels compared; largest error " << worst / 255 << " texels of " << kTexelBound << "\n";
  // A whole step between neighbours is 255 levels; the fraction of the coordinate is itself a float.
  EXPECT_LE(worst, (kTexelBound + kWidth * 0x1p-23) * 255 + 0.02);
  EXPECT_GT(doubles, 10u);
}

// With the eye in between: the near plane lies at w = near, so that what has a corner before it is cut.
Primitive3 random_cut_primitive(Random& random) {
  Primitive3 p;
  const float scale = random.integer(0, 19) == 0 ? float(std::pow(10.0, double(random.real(-20, 25)))) : 1;
  const float near = scale * float(std::pow(10.0, double(random.real(-3, 0))));
  const float reach = random.integer(0, 1) == 0 ? 1 : float(std::pow(2.0, double(random.real(-4, 3))));
  const auto in_front = size_t(random.integer(0, 2));
  for (size_t i = 0; i < 3; ++i) {
    Vertex& v = p.vertices[i];
    v.w = i == in_front ? near * random.real(-3, 1) : scale * random.real(0, 1) + near;
    const float size = std::max(std::fabs(v.w), near) * reach;
    v.x = size * random.real(-1, 1);
    v.y = size * random.real(-1, 1);
    v.z = v.w - 2 * near;
  }
  return p;
}

// Drawn at the standard level, with all but its planes and the divide by w exact, and all exact: the largest difference,
// in levels: of colours, or of the view's texels.
Count compare_with_exact(uint64_t seed, const std::shared_ptr<const TextureView>& view, bool cut) {
  Random random(seed);
  Count result;
  Canvas canvas(kSize, kSize, 1, ColorFormat::rgba32f);
  std::vector<float> pixels(kSize * kSize * 4), exact(kSize * kSize * 4);
  for (int n = 0; n < primitives(); ++n) {
    const int viewport = n % 3 == 0 ? 64 : n % 3 == 1 ? 512 : 8192;
    Primitive3 p = cut ? random_cut_primitive(random) : random_primitive(random);
    const float turns = float(std::pow(10.0, double(random.real(-2, 3))));
    const float most = random.integer(0, 1) == 0 ? 1 : float(std::pow(10.0, double(random.real(-7, -1))));
    for (Vertex& v : p.vertices) {
      v.s = random.real(0, turns), v.t = random.real(0, turns);
      if (view == nullptr) v.color = {random.real(0, most), random.real(0, most), random.real(0, most), random.real(0, most)};
    }
    DrawState state = plain_state(viewport, viewport);
    state.texture.view = view;
    state.texture.env = EnvMode::replace;
    state.viewport.x = state.viewport.y = kSize / 2 - viewport / 2;
    state.accuracy = Accuracy::all(Level::exact);
    canvas.clear();
    canvas.draw(state, Primitive::triangles, p.vertices);
    canvas.device().read_color_float({0, 0, kSize, kSize}, exact.data());
    state.accuracy.interpolation = state.accuracy.perspective = Level::standard;
    const auto before = canvas.device().statistics();
    canvas.clear();
    canvas.draw(state, Primitive::triangles, p.vertices);
    canvas.device().read_color_float({0, 0, kSize, kSize}, pixels.data());
    const auto after = canvas.device().statistics();
    if (after.fragments == before.fragments) continue;
    ++result.primitives;
    if (after.double_fragments != before.double_fragments) ++result.in_double;
    for (size_t i = 0; i < pixels.size(); ++i)
      result.worst = std::max(result.worst, std::fabs(double(pixels[i]) - double(exact[i])) * 255);
  }
  return result;
}

void expect_near(const Count& count, double bound) {
  const uint64_t floats = count.primitives - count.in_double;
  std::cout << floats << " primitives in float, " << count.in_double << " in double; largest error " << count.worst
            << " levels of " << bound << "\n";
  EXPECT_LE(count.worst, bound);
  EXPECT_GT(floats, count.in_double / 10);
  EXPECT_GT(count.in_double, floats / 100);
}

constexpr double kStep = 255 * kTexelBound;  // levels, along either axis

std::shared_ptr<const TextureView> noise_view(TestTexture& texture, int levels) {
  Random random(78);
  for (int n = 0; n < levels; ++n) texture.add_noise(random, 256 >> n, 256 >> n);
  return texture.view(sampler_of(Filter::linear, Wrap::repeat, levels > 1 ? MipMode::linear : MipMode::none));
}

// On mip levels coordinates are as near in texels of the level looked up. Level and filter are exact, so that only
// coordinates differ from those in double.
TEST(PrecisionOnDemand, CoordinatesAreAsNearOnTheLevelLookedUp) {
  TestTexture texture;
  expect_near(compare_with_exact(78, noise_view(texture, 9), false), 2 * kStep + 0.02);
}

TEST(PrecisionOnDemand, ColoursOfCutTrianglesAreAsNear) {
  expect_near(compare_with_exact(79, nullptr, true), kColorBound + kSlack);
}

TEST(PrecisionOnDemand, CoordinatesOfCutTrianglesAreAsNear) {
  TestTexture texture, mips;
  expect_near(compare_with_exact(80, noise_view(texture, 1), true), 2 * kStep + 0.02);
  expect_near(compare_with_exact(81, noise_view(mips, 9), true), 2 * kStep + 0.02);
}

}  // namespace
}  // namespace halfspace::test
