// Numbers that are none, and numbers too large or too small: no crash, and the next frame is right.
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/canvas.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"
#include "tests/support/textures.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 96;

float odd_number(Random& random) {
  using Limits = std::numeric_limits<float>;
  static constexpr float kNumbers[] = {Limits::quiet_NaN(),
                                       Limits::infinity(),
                                       Limits::max(),
                                       1e38f,
                                       1e30f,
                                       1e20f,
                                       1e10f,
                                       65536,
                                       1,
                                       0.5f,
                                       1e-10f,
                                       1e-30f,
                                       1e-38f,
                                       Limits::min(),
                                       Limits::denorm_min(),
                                       0,
                                       -0.0f,
                                       0.1f};
  const float value = kNumbers[random.integer(0, int64_t(std::size(kNumbers)) - 1)];
  return random.integer(0, 1) ? value : -value;
}

// One odd number in `rate`, the others ordinary.
float number(Random& random, int rate, float low, float high) {
  return random.integer(1, rate) == 1 ? odd_number(random) : random.real(low, high);
}

std::vector<Vertex> odd_vertices(Random& random, int count, int rate) {
  std::vector<Vertex> vertices;
  for (int i = 0; i < count; ++i) {
    Vertex v;
    v.x = number(random, rate, -2, 2);
    v.y = number(random, rate, -2, 2);
    v.z = number(random, rate, -2, 2);
    v.w = number(random, rate, -0.5f, 2);
    v.color = {number(random, rate, -1, 2), number(random, rate, -1, 2), number(random, rate, -1, 2),
               number(random, rate, -1, 2)};
    v.s = number(random, rate, -9, 9);
    v.t = number(random, rate, -9, 9);
    v.q = number(random, rate, -1, 2);
    vertices.push_back(v);
  }
  return vertices;
}

DrawState odd_state(Random& random, TestTexture& texture) {
  DrawState state = plain_state(kSize, kSize);
  state.depth.test = random.integer(0, 1) == 1;
  state.raster.flat_shading = random.integer(0, 1) == 1;
  state.accuracy = Accuracy::all(Level(random.integer(0, 2)));
  if (random.integer(0, 1)) {
    const MipMode mip = MipMode(random.integer(0, 2));
    const Wrap wrap = Wrap(random.integer(0, 2));
    state.texture.view = texture.view(sampler_of(Filter(random.integer(0, 1)), wrap, mip));
    if (random.integer(0, 3) == 0) {
      for (double& e : state.texture.matrix) e = double(number(random, 6, -2, 2));
      state.texture.matrix_is_identity = false;
    }
  }
  if (random.integer(0, 3) == 0)
    state.blend = {true, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha};
  if (random.integer(0, 5) == 0) {
    for (double& e : state.clip_from_object) e = double(number(random, 6, -2, 2));
  }
  if (random.integer(0, 7) == 0) {
    state.viewport = {int(random.integer(-9000, 9000)),
                      int(random.integer(-9000, 9000)),
                      int(random.integer(0, 16384)),
                      int(random.integer(0, 16384)),
                      0,
                      1};
  }
  state.raster.scissor_test = random.integer(0, 3) == 0;
  state.raster.scissor = {int(random.integer(-2147483647, 100)), int(random.integer(-100, 100)),
                          int(random.integer(-100, 2147483647)), int(random.integer(-100, 200))};
  return state;
}

TEST(BadInput, NextFrameIsRight) {
  const std::vector<Scene> good = scenes(kSize);
  std::vector<Picture> expected;
  for (const Scene& scene : good) {
    Canvas canvas(kSize, kSize);
    draw_scene(canvas, scene);
    expected.push_back(canvas.read());
  }
  Random random(1);
  TestTexture texture;
  for (int size = 16; size > 0; size /= 2) texture.add_noise(random, size, size);
  Canvas canvas(kSize, kSize, 2);
  for (int round = 0; round < (long_tests() ? 5000 : 200); ++round) {
    for (int draw = 0; draw < 4; ++draw) {
      const DrawState state = odd_state(random, texture);
      const Primitive primitive = Primitive(random.integer(0, 9));
      canvas.draw(state, primitive,
                  odd_vertices(random, int(random.integer(1, 40)), int(random.integer(1, 12))));
    }
    canvas.clear();
    const size_t check = size_t(round) % good.size();
    draw_scene(canvas, good[check]);
    ASSERT_EQ(first_difference(expected[check], canvas.read()), "") << "after round " << round;
  }
}

// Spec 2.11 leaves a vertex without a position undefined; here its primitives are dropped, and no others.
TEST(BadInput, PrimitivesWithoutPositionAreDropped) {
  for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    for (int component = 0; component < 4; ++component) {
      std::vector<Vertex> v = snapped_quad(0, 0, 256 * kSize, 256 * kSize, 128);
      std::vector<Vertex> triangles{v[0], v[1], v[2], v[0], v[2], v[3]};
      (&triangles[4].x)[component] = bad;
      Canvas canvas(kSize, kSize);
      canvas.draw_plain(plain_state(128, 128), Primitive::triangles, triangles, {1, 1, 1, 1});
      const Picture picture = canvas.read();
      EXPECT_EQ(int(picture.pixel(kSize - 2, 1)[0]), 255);
      EXPECT_EQ(int(picture.pixel(1, kSize - 2)[0]), 0) << bad << " in component " << component;
    }
  }
}

// Whichever corner it is, and wherever the other two are.
TEST(BadInput, TrianglesWithACornerThatIsNoNumberAreDropped) {
  for (size_t corner = 0; corner < 3; ++corner) {
    for (int component = 0; component < 4; ++component) {
      Vertex v[3] = {snapped_vertex(256 * 5, 256 * 9, 128), snapped_vertex(256 * (kSize - 3), 256 * 20, 128),
                     snapped_vertex(256 * 30, 256 * (kSize - 4), 128)};
      (&v[corner].x)[component] = std::numeric_limits<float>::quiet_NaN();
      Canvas canvas(kSize, kSize);
      canvas.draw_plain(plain_state(128, 128), Primitive::triangles, v, {1, 1, 1, 1});
      EXPECT_EQ(canvas.device().statistics().fragments, 0u) << "component " << component << " of corner " << corner;
      for (uint8_t byte : canvas.read().rgba) ASSERT_EQ(int(byte), 0) << "component " << component << " of corner " << corner;
    }
  }
}

TEST(BadInput, EmptyDrawsAndEmptyViewports) {
  Canvas canvas(kSize, kSize);
  const std::vector<Vertex> quad = snapped_quad(0, 0, 256 * kSize, 256 * kSize, 128);
  DrawState state = plain_state(0, 0);
  canvas.draw(state, Primitive::quads, quad);
  state = plain_state(128, 128);
  state.raster.scissor_test = true;
  state.raster.scissor = {10, 10, 10, 20};
  canvas.draw(state, Primitive::quads, quad);
  for (int primitive = 0; primitive < 10; ++primitive) {
    // Fewer vertices than one primitive needs (spec 2.6.1).
    const size_t too_few[] = {0, 1, 1, 1, 2, 2, 2, 3, 3, 2};
    canvas.draw(plain_state(128, 128), Primitive(primitive), {quad.data(), too_few[primitive]});
  }
  for (uint8_t byte : canvas.read().rgba) ASSERT_EQ(int(byte), 0);
}

// Reading and clearing rectangles that reach beyond the framebuffer.
TEST(BadInput, RectanglesBeyondTheFramebuffer) {
  Canvas canvas(kSize, kSize);
  canvas.clear({1, 1, 1, 1});
  constexpr int kBeyond = 16, kWide = kSize + 2 * kBeyond;
  std::vector<uint8_t> bytes(4 * kWide * kWide, 77);
  canvas.device().read_color({-kBeyond, -kBeyond, kSize + kBeyond, kSize + kBeyond}, bytes.data());
  for (int y = 0; y < kWide; ++y) {
    for (int x = 0; x < kWide; ++x) {
      const bool inside = x >= kBeyond && y >= kBeyond && x < kBeyond + kSize && y < kBeyond + kSize;
      ASSERT_EQ(int(bytes[size_t(4 * (y * kWide + x))]), inside ? 255 : 77) << x << ", " << y;
    }
  }
  ClearCommand clear;
  clear.color = true;
  clear.scissor_test = true;
  clear.scissor = {-2147483647, 90, 2147483647, 2147483647};
  canvas.device().clear(clear);
  const Picture picture = canvas.read();
  EXPECT_EQ(int(picture.pixel(5, 89)[0]), 255);
  EXPECT_EQ(int(picture.pixel(5, 90)[0]), 0);
}

}  // namespace
}  // namespace halfspace::test
