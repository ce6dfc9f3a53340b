// The dial: how far each level is from the truth, and that no level touches what it must not.
#include <gtest/gtest.h>

#include <boost/multiprecision/mpfr.hpp>
#include <cmath>
#include <cstring>
#include <limits>

#include "tests/oracle/fragment.h"
#include "tests/oracle/triangle.h"
#include "tests/support/canvas.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"
#include "tests/support/textures.h"

namespace halfspace::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity(),
                 kNan = std::numeric_limits<double>::quiet_NaN();

using namespace raster;
#define HWY_INLINE inline
#include "raster/exact_math.inl"
#undef HWY_INLINE

using Exact = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<50>>;

constexpr int kSize = 128;

// --- A pipeline of one textured, coloured, fogged triangle against the oracle's formulas.

struct Pipeline {
  std::vector<Vertex> vertices = std::vector<Vertex>(3);
  std::array<oracle::ClipPoint, 3> clip;
  std::array<std::array<long double, 3>, 8> values;  // r g b a s t q z
  DrawState state;
  Color env_color;
};

// Distances from the eye come from object coordinates, so a matrix takes those to clip coordinates.
Pipeline random_pipeline(Random& random, const TextureUnitState& unit, bool perspective, bool projective) {
  Pipeline p;
  p.state = plain_state(kSize, kSize);
  p.state.texture = unit;
  // w = -z, x and y as they are; depth somewhere in the middle.
  p.state.clip_from_object = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0};
  const float side = random.real(0.5f, 6);
  for (size_t i = 0; i < 3; ++i) {
    Vertex& v = p.vertices[i];
    v.z = -(perspective ? random.real(0.5f, 6) : side);
    v.x = -v.z * random.real(-1.5f, 1.5f);
    v.y = -v.z * random.real(-1.5f, 1.5f);
    v.color = {random.real(0, 1), random.real(0, 1), random.real(0, 1), random.real(0, 1)};
    const float scale = float(int64_t{1} << random.integer(0, 5)) / 2;
    v.s = random.real(-scale, scale);
    v.t = random.real(-scale, scale);
    v.q = projective ? random.real(0.5f, 2) : 1;
    p.clip[i] = {double(v.x), double(v.y), 0, double(-v.z)};
    const float in_order[] = {v.color.r, v.color.g, v.color.b, v.color.a, v.s, v.t, v.q, -v.z};
    for (size_t k = 0; k < 8; ++k) p.values[k][i] = static_cast<long double>(in_order[k]);
  }
  return p;
}

long double fog_factor(const FogState& fog, long double z) {
  const auto density = (long double)(fog.density), start = (long double)(fog.start),
             end = (long double)(fog.end);
  if (fog.mode == FogMode::linear) return std::fmin(std::fmax((end - z) / (end - start), 0.0L), 1.0L);
  return fog.mode == FogMode::exp ? std::exp(-density * z) : std::exp(-density * z * density * z);
}

oracle::Rgba true_color(const Pipeline& p, const oracle::Triangle& triangle, const oracle::Texture& texture,
                        int x, int y) {
  oracle::Rgba color;
  for (size_t k = 0; k < 4; ++k)
    color[k] = std::fmin(std::fmax(triangle.attribute(p.values[k], x, y).value, 0.0L), 1.0L);
  const auto s = triangle.projected(p.values[4], p.values[6], x, y),
             t = triangle.projected(p.values[5], p.values[6], x, y);
  const oracle::Lookup lookup = oracle::sample(texture, s, t);
  const Color& c = p.state.texture.env_color;
  const oracle::Rgba constant{(long double)(c.r), (long double)(c.g), (long double)(c.b), (long double)(c.a)};
  color = oracle::environment(p.state.texture.env, p.state.texture.view->base_format, color, lookup.color,
                              constant);
  const FogState& fog = p.state.fog;
  if (!fog.enabled) return color;
  const long double f = fog_factor(fog, triangle.attribute(p.values[7], x, y).value);
  const float own[] = {fog.color.r, fog.color.g, fog.color.b};
  for (size_t k = 0; k < 3; ++k) color[k] = f * color[k] + (1 - f) * (long double)(own[k]);
  return color;
}

// The largest difference, in levels, over random triangles.
double worst_difference(const Accuracy& accuracy, uint64_t seed, int rounds) {
  Random random(seed);
  double worst = 0;
  for (int round = 0; round < rounds; ++round) {
    TestTexture texture;
    const int size = round % 3 == 2 ? 24 : 32;
    for (int side = size; side >= 1; side /= 2) texture.add_noise(random, side, side);
    Sampler sampler =
        sampler_of(Filter::linear, Wrap(round % 3), round % 2 == 0 ? MipMode::linear : MipMode::none);
    sampler.mag = Filter::linear;
    sampler.border_color = {0.2f, 0.4f, 0.8f, 0.6f};
    const oracle::Texture reference = texture.reference(sampler);
    TextureUnitState unit;
    unit.view = texture.view(sampler);
    unit.env = EnvMode(round % 4);
    unit.env_color = {random.real(0, 1), random.real(0, 1), random.real(0, 1), random.real(0, 1)};
    Pipeline p = random_pipeline(random, unit, round % 5 != 4, round % 4 == 3);
    if (round % 3 != 0) p.state.fog = {true, FogMode(round / 3 % 3), {0.9f, 0.3f, 0.6f, 0}, 0.4f, 1, 5};
    p.state.accuracy = accuracy;
    const oracle::Triangle triangle(p.state.viewport, p.clip);
    Canvas canvas(kSize, kSize);
    canvas.draw(p.state, Primitive::triangles, p.vertices);
    const Picture picture = canvas.read();
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        if (!triangle.covers(x, y)) continue;
        const oracle::Rgba truth = true_color(p, triangle, reference, x, y);
        for (size_t k = 0; k < 4; ++k) {
          const double error = std::fabs(double(oracle::level_of(truth[k])) - picture.pixel(x, y)[k]);
          worst = std::max(worst, error);
        }
      }
    }
  }
  return worst;
}

int rounds() { return long_tests() ? 400 : 24; }

TEST(Accuracy, ExactRoundsOnce) {
  const double worst = worst_difference(Accuracy::all(Level::exact), 1, rounds());
  EXPECT_LE(worst, 0.5001);
  RecordProperty("worst", std::to_string(worst));
}

TEST(Accuracy, StandardIsWithinFiveHundredthsOfRounding) {
  const double worst = worst_difference({}, 1, rounds());
  EXPECT_LE(worst, 0.55);
  EXPECT_GT(worst, 0.5001);  // or the test could not tell the levels apart
}

// Draft has no such bound; but it draws the same picture, give or take.
TEST(Accuracy, EachAxisAtDraftIsWorseThanStandardAndNotByMuch) {
  // Levels, over the same triangles: what each axis may cost. The filter's: docs/numerics.md.
  const std::pair<Level Accuracy::*, double> most[] = {{&Accuracy::filter, 3.1}, {&Accuracy::fog, 0.57}};
  const double standard = worst_difference({}, 1, rounds());
  for (const auto& [axis, bound] : most) {
    Accuracy accuracy;
    accuracy.*axis = Level::draft;
    const double worst = worst_difference(accuracy, 1, rounds());
    EXPECT_LE(worst, bound);
    EXPECT_GT(worst, standard);
  }
}

// --- Blending, of a colour that has become bytes (spec 2.14.9), rounded once.

TEST(Accuracy, ExactBlendingRoundsOnce) {
  Random random(5);
  for (int round = 0; round < 2000; ++round) {
    Canvas canvas(2, 2);
    const Color below{float(random.integer(0, 255)) / 255, float(random.integer(0, 255)) / 255,
                      float(random.integer(0, 255)) / 255, float(random.integer(0, 255)) / 255};
    canvas.clear(below);
    const Picture before = canvas.read();
    const Color color{random.real(0, 1), random.real(0, 1), random.real(0, 1), random.real(0, 1)};
    DrawState state = plain_state(2, 2);
    state.accuracy = Accuracy::all(Level::exact);
    state.blend = {true, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha};
    canvas.draw_plain(state, Primitive::quads, snapped_quad(0, 0, 512, 512, 2), color);
    const Picture after = canvas.read();
    const uint8_t* is = after.pixel(1, 1);
    const float own[] = {color.r, color.g, color.b, color.a};
    for (int k = 0; k < 4; ++k) {
      const auto byte = [&own](int channel) { return floor(Exact(own[channel]) * 255 + Exact(0.5)); };
      const Exact alpha = byte(3) / 255, truth = alpha * byte(k) + (1 - alpha) * before.pixel(1, 1)[k];
      EXPECT_LE(abs(truth - is[k]), Exact("0.5000001")) << round << ", " << k;
    }
  }
}

// An alpha that equals the reference passes GEQUAL, whatever it rounds to.
TEST(Accuracy, AlphaEqualToTheReferencePasses) {
  for (Level level : {Level::draft, Level::standard, Level::exact}) {
    for (int i = 0; i <= 1000; ++i) {
      const float alpha = float(i) / 1000;
      DrawState state = plain_state(2, 2);
      state.accuracy = Accuracy::all(level);
      state.alpha_test = {true, CompareFunc::equal, alpha};
      Canvas canvas(2, 2);
      canvas.draw_plain(state, Primitive::quads, snapped_quad(0, 0, 512, 512, 2), {1, 1, 1, alpha});
      ASSERT_EQ(int(canvas.read().pixel(0, 0)[0]), 255) << "alpha " << alpha << ", level " << int(level);
    }
  }
}

// --- No level opens a crack: coverage and depth are the same at all.

TEST(Accuracy, CoverageAndDepthAreTheSameAtEveryLevel) {
  for (const Scene& scene : scenes(kSize)) {
    std::vector<Picture> pictures;
    for (Level level : {Level::draft, Level::standard, Level::exact}) {
      Canvas canvas(kSize, kSize);
      for (SceneDraw draw : scene.draws) {
        draw.state.accuracy = Accuracy::all(level);
        // What is drawn may depend on a colour here, which levels may change.
        draw.state.alpha_test.enabled = false;
        // And a smooth polygon's fragments are where it is found to cover anything.
        draw.state.polygon.smooth = false;
        canvas.draw(draw.state, draw.primitive, draw.vertices, draw.indices);
      }
      pictures.push_back(canvas.read());
    }
    EXPECT_EQ(pictures[0].depth, pictures[1].depth) << scene.name;
    EXPECT_EQ(pictures[2].depth, pictures[1].depth) << scene.name;
  }
}

// Spec App. A, rule 2: which fragments the scissor lets through does not change them. At draft runs are
// longer than blocks, and small triangles go another way.
TEST(Accuracy, ScissorChangesNoFragment) {
  for (Level level : {Level::draft, Level::exact}) {
    for (const Scene& scene : scenes(kSize)) {
      Canvas whole(kSize, kSize), cut(kSize, kSize);
      const Rect box{13, 21, 90, 102};
      for (SceneDraw draw : scene.draws) {
        if (draw.state.raster.scissor_test) continue;
        draw.state.accuracy = Accuracy::all(level);
        whole.draw(draw.state, draw.primitive, draw.vertices, draw.indices);
        draw.state.raster.scissor_test = true;
        draw.state.raster.scissor = box;
        cut.draw(draw.state, draw.primitive, draw.vertices, draw.indices);
      }
      EXPECT_EQ(first_difference(whole.read(box), cut.read(box)), "")
          << scene.name << ", level " << int(level);
    }
  }
}

// --- The polynomials of the exact level.

double ulps(double is, const Exact& truth) {
  const double nearest = truth.convert_to<double>();
  const double ulp = std::nextafter(std::fabs(nearest), INFINITY) - std::fabs(nearest);
  return double((abs(Exact(is) - truth) / ulp).convert_to<double>());
}

TEST(ExactMath, ExponentialIsWithinAnUlp) {
  Random random(2);
  double worst = 0;
  for (int i = 0; i < (long_tests() ? 1000000 : 20000); ++i) {
    const double x = double(random.real(0, 1)) * (i % 2 ? 1 : 690);
    worst = std::max(worst, ulps(ExactExpMinus(x), exp(Exact(-x))));
  }
  EXPECT_LE(worst, 1);
  EXPECT_EQ(ExactExpMinus(0), 1);
  EXPECT_EQ(ExactExpMinus(kInfinity), 0);
  EXPECT_EQ(ExactExpMinus(kNan), 0);
}

TEST(ExactMath, LogarithmIsWithinTwoUlpsOfItsSizeAndExactAtPowersOfTwo) {
  Random random(3);
  double worst = 0;
  for (int i = 0; i < (long_tests() ? 1000000 : 20000); ++i) {
    const double x = std::ldexp(1 + double(random.real(0, 1)), int(random.integer(-100, 100)));
    const Exact truth = log2(Exact(x));
    const double error = abs(Exact(ExactLog2(x)) - truth).convert_to<double>();
    worst = std::max(worst, error / std::max(1.0, std::fabs(truth.convert_to<double>())));
  }
  EXPECT_LE(worst, 2 * 0x1p-53 * 1.5);
  for (int n = -126; n <= 127; ++n) EXPECT_EQ(ExactLog2(std::ldexp(1.0, n)), n);
}

// As a float it is right to one unit in the last place.
TEST(ExactMath, PowerIsWithinAnUlpOfFloat) {
  Random random(4);
  double worst = 0;
  for (int i = 0; i < (long_tests() ? 1000000 : 20000); ++i) {
    const double x = i % 2 ? double(random.real(0, 1)) : 1 - double(random.real(0, 1)) * 1e-3;
    const double s = double(random.real(0, 128));
    const Exact truth = pow(Exact(x), Exact(s));
    if (truth < 0x1p-125) continue;
    worst = std::max(worst, (abs(Exact(ExactPower(x, s)) - truth) / truth).convert_to<double>());
  }
  EXPECT_LE(worst, 1e-12);
  EXPECT_EQ(ExactPower(0, 0), 1);
  EXPECT_EQ(ExactPower(0, 2), 0);
  EXPECT_EQ(ExactPower(kNan, 2), 0);
  EXPECT_EQ(ExactPower(0.25, 2), 0.0625);
}

}  // namespace
}  // namespace halfspace::test
