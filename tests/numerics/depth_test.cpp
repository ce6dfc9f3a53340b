// Depth: exact to the last of 24 bits, the same whatever else is switched on.
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "tests/oracle/fragment.h"
#include "tests/oracle/triangle.h"
#include "tests/support/canvas.h"
#include "tests/support/random.h"

namespace halfspace::test {
namespace {

using namespace raster;
using oracle::SnappedTriangle;

constexpr int kViewport = 128, kWidth = 96, kHeight = 80;
constexpr uint32_t kMaxDepth = (1u << 24) - 1;

DrawState depth_state(CompareFunc func = CompareFunc::less) {
  DrawState state = plain_state(kViewport, kViewport);
  state.depth = {true, func, true};
  return state;
}

std::vector<Vertex> random_triangles(Random& random, int count, bool perspective) {
  std::vector<Vertex> vertices;
  for (int i = 0; i < 3 * count; ++i) {
    Vertex v = snapped_vertex(random.integer(-20 * 256, 110 * 256), random.integer(-20 * 256, 110 * 256),
                              kViewport, random.real(-1, 1));
    v.color = {random.real(0, 1), random.real(0, 1), random.real(0, 1), random.real(0, 1)};
    v.s = random.real(-3, 3);
    v.t = random.real(-3, 3);
    // A power of two keeps x / w exact.
    if (perspective) {
      const float w = float(1 << random.integer(0, 4));
      v.x *= w, v.y *= w, v.z *= w, v.w = w;
    }
    vertices.push_back(v);
  }
  return vertices;
}

// Depth of the plane through snapped corners, to 50 digits.
TEST(Depth, NearestIntegerAtEveryPixel) {
  using Real = boost::multiprecision::cpp_bin_float_50;
  Random random(1);
  for (int i = 0; i < (long_tests() ? 400 : 25); ++i) {
    const std::vector<Vertex> v = random_triangles(random, 1, false);
    SnappedTriangle corners;
    std::array<Real, 3> z;
    for (size_t k = 0; k < 3; ++k) {
      corners[k] = {std::llround((double(v[k].x) + 1) * 64 * 256),
                    std::llround((double(v[k].y) + 1) * 64 * 256)};
      z[k] = (Real(v[k].z) + 1) / 2;
    }
    Canvas canvas(kWidth, kHeight);
    canvas.draw_plain(depth_state(CompareFunc::always), Primitive::triangles, v, {1, 1, 1, 1});
    const Picture picture = canvas.read();
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (!oracle::covers(corners, x, y)) {
          ASSERT_EQ(picture.depth_at(x, y), kMaxDepth);
          continue;
        }
        const Real exact = oracle::affine(corners, z, x, y).value * kMaxDepth;
        const double error = Real(abs(exact - picture.depth_at(x, y))).convert_to<double>();
        // Half a unit, and what doubles lose on the way (2^-29 of it) with room to spare.
        ASSERT_LE(error, 0.5 + 1e-5) << "triangle " << i << ", pixel " << x << ", " << y << ": is "
                                     << picture.depth_at(x, y) << ", exact " << exact;
      }
    }
  }
}

std::shared_ptr<const TextureView> noise_texture(Random& random) {
  std::vector<uint8_t> texels(16 * 16 * 4);
  for (uint8_t& t : texels) t = uint8_t(random.bits());
  Texture texture;
  texture.define_level(0, 16, 16, 0, BaseFormat::rgba, texels.data(), 16 * 4);
  Sampler sampler;
  sampler.mip = MipMode::none;
  sampler.min = Filter::linear;
  return texture.view(sampler, 1);
}

// Spec appendix A, invariance: state that depth does not depend on does not change it. Every way of drawing
// the scene again finds the depth it left the first time, at all accuracies.
TEST(Depth, EqualPassesWhateverElseIsSwitchedOn) {
  Random random(2);
  std::vector<DrawState> variants;
  for (int i = 0; i < 10; ++i) variants.push_back(depth_state(CompareFunc::equal));
  variants[1].texture.view = noise_texture(random);
  variants[2].blend = {true, BlendFactor::one, BlendFactor::one};
  variants[3].alpha_test = {true, CompareFunc::greater_equal, 0};
  variants[4].raster.flat_shading = true;
  variants[5].accuracy = Accuracy::all(Level::draft);
  variants[6].accuracy = Accuracy::all(Level::exact);
  variants[7].raster.scissor_test = true;
  variants[7].raster.scissor = {0, 0, kWidth, kHeight};
  variants[8].color_mask.a = false;
  variants[9].texture.view = variants[1].texture.view;
  variants[9].blend = variants[2].blend;
  variants[9].accuracy = Accuracy::all(Level::exact);
  for (bool perspective : {false, true}) {
    const std::vector<Vertex> scene = random_triangles(random, 40, perspective);
    for (size_t first = 0; first < variants.size(); ++first) {
      for (size_t second = 0; second < variants.size(); ++second) {
        if (!long_tests() && first != 0 && second != 0) continue;
        Canvas canvas(kWidth, kHeight, 2);
        DrawState lay = variants[first];
        lay.depth.func = CompareFunc::less;
        canvas.draw(lay, Primitive::triangles, scene);
        const Picture before = canvas.read();
        // Clear the colour only, and draw white: a pixel that stays black did not pass.
        ClearCommand clear;
        clear.color = true;
        canvas.device().clear(clear);
        DrawState again = variants[second];
        std::vector<Vertex> white = scene;
        for (Vertex& v : white) v.color = {1, 1, 1, 1};
        again.texture.env = EnvMode::blend;  // white, whatever the texture says
        again.texture.env_color = {1, 1, 1, 1};
        canvas.draw(again, Primitive::triangles, white);
        const Picture after = canvas.read();
        ASSERT_EQ(before.depth, after.depth);
        for (int y = 0; y < kHeight; ++y) {
          for (int x = 0; x < kWidth; ++x) {
            if (before.depth_at(x, y) == kMaxDepth) continue;
            ASSERT_NE(int(after.pixel(x, y)[0]), 0)
                << "drawn as " << first << ", again as " << second << ", pixel " << x << ", " << y;
          }
        }
      }
    }
  }
}

// Sloping planes 2^-24 apart, drawn in a random order: the nearest is seen everywhere, none passes through
// another.
TEST(Depth, LadderKeepsItsOrder) {
  Random random(3);
  constexpr int kRungs = 64;
  const float slopes[][2] = {{0, 0}, {0.25f, 0}, {0.1f, -0.2f}, {-0.3f, 0.17f}};
  for (const auto& slope : slopes) {
    std::vector<std::vector<uint32_t>> depth;
    for (int k = 0; k < kRungs; ++k) {
      std::vector<Vertex> quad = snapped_quad(0, 0, 96 * 256, 80 * 256, kViewport);
      // The clip cube is twice as deep as the depth range: 2^-23 in z is 2^-24 in depth. Slopes are cut to 12
      // bits so that no sum is rounded.
      const auto cut = [](float v) { return std::nearbyint(v * 4096) / 4096; };
      for (Vertex& v : quad) v.z = 0.125f + cut(slope[0] * v.x) + cut(slope[1] * v.y) + float(k) * 0x1p-23f;
      Canvas canvas(kWidth, kHeight);
      canvas.draw_plain(depth_state(CompareFunc::always), Primitive::quads, quad, {1, 1, 1, 1});
      depth.push_back(canvas.read().depth);
      for (const Vertex& v : quad) ASSERT_LT(std::fabs(v.z), 1);
    }
    for (size_t k = 1; k < kRungs; ++k) {
      for (size_t i = 0; i < depth[k].size(); ++i) {
        // A unit is 1 / (2^24 - 1), so a rung is a 2^-24th part less than a unit: at most one pair in 64 may
        // tie.
        ASSERT_LE(depth[k][i] - depth[k - 1][i], 1u);
        if (k >= 2) {
          ASSERT_GT(depth[k][i], depth[k - 2][i]);
        }
      }
    }
  }
}

TEST(Depth, ReversedRangeMirrors) {
  Random random(4);
  const std::vector<Vertex> scene = random_triangles(random, 30, true);
  DrawState forward = depth_state(CompareFunc::less), backward = depth_state(CompareFunc::greater);
  backward.viewport.depth_near = 1;
  backward.viewport.depth_far = 0;
  Canvas a(kWidth, kHeight), b(kWidth, kHeight);
  a.clear({}, 1), b.clear({}, 0);
  a.draw(forward, Primitive::triangles, scene);
  b.draw(backward, Primitive::triangles, scene);
  const Picture p = a.read(), q = b.read();
  EXPECT_EQ(p.rgba, q.rgba);
  for (size_t i = 0; i < p.depth.size(); ++i) ASSERT_EQ(p.depth[i], kMaxDepth - q.depth[i]) << "pixel " << i;
}

TEST(Depth, ClearDrawAndReadConvertAlike) {
  Random random(5);
  Canvas canvas(16, 16);
  for (int i = 0; i < 400; ++i) {
    const double depth = i < 2 ? i : double(random.bits() >> 11) * 0x1p-53;
    canvas.clear({}, depth);
    const uint32_t expected = uint32_t(std::floor(depth * kMaxDepth + 0.5));
    ASSERT_EQ(canvas.read().depth_at(3, 4), expected) << depth;
    DrawState state = plain_state(16, 16);
    state.depth = {true, CompareFunc::equal, true};
    state.viewport.depth_near = state.viewport.depth_far = depth;
    canvas.draw_plain(state, Primitive::quads, snapped_quad(0, 0, 16 * 256, 16 * 256, 16), {1, 1, 1, 1});
    ASSERT_EQ(int(canvas.read().pixel(3, 4)[0]), 255) << depth;
  }
}

TEST(Depth, FunctionsCompareAsTheirNamesSay) {
  for (int f = 0; f < 8; ++f) {
    for (int delta = -1; delta <= 1; ++delta) {
      for (bool write : {true, false}) {
        const uint32_t stored = 9000000, incoming = uint32_t(int(stored) + delta);
        Canvas canvas(20, 20);
        canvas.clear({}, double(stored) / kMaxDepth);
        DrawState state = plain_state(16, 16);
        state.depth = {true, CompareFunc(f), write};
        state.viewport.depth_near = state.viewport.depth_far = double(incoming) / kMaxDepth;
        canvas.draw_plain(state, Primitive::quads, snapped_quad(0, 0, 16 * 256, 16 * 256, 16), {1, 1, 1, 1});
        const Picture picture = canvas.read();
        const bool passes = oracle::compare(CompareFunc(f), delta, 0);
        EXPECT_EQ(picture.pixel(5, 6)[1] == 255, passes) << "function " << f << ", delta " << delta;
        EXPECT_EQ(picture.depth_at(5, 6), passes && write ? incoming : stored) << "function " << f;
        EXPECT_EQ(picture.depth_at(18, 18), stored);
      }
    }
  }
}

// Spec 4.1.6: with the test off the buffer is not written either.
TEST(Depth, TestOffDoesNotWrite) {
  Canvas canvas(16, 16);
  canvas.clear({}, 0.25);
  DrawState state = plain_state(16, 16);
  state.depth.write = true;
  canvas.draw_plain(state, Primitive::quads, snapped_quad(0, 0, 16 * 256, 16 * 256, 16, -1), {1, 1, 1, 1});
  EXPECT_EQ(canvas.read().depth_at(8, 8), uint32_t(std::floor(0.25 * kMaxDepth + 0.5)));
}

}  // namespace
}  // namespace halfspace::test
