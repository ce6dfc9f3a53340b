// The vertex stage against a scalar model in long double, and every ISA level against the others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <sstream>
#include <string>

#include "raster/api/device.h"
#include "raster/vertex/vertex_stage.h"
#include "raster/vertex/window_transform.h"

namespace halfspace::raster {
namespace {

struct Shaded {
  ShadedVertices vertices;
  std::vector<uint64_t> storage;
};

Shaded shade(const DrawState& state, const VertexBatch& batch) {
  Shaded s;
  s.vertices.layout = choose_layout(state, batch);
  s.vertices.count = batch.count;
  s.storage.assign(batch.count * s.vertices.layout.stride() / 8 + 1, 0);
  s.vertices.records = reinterpret_cast<std::byte*>(s.storage.data());
  s.vertices.outcodes.resize(batch.count);
  s.vertices.clip = {batch.position, state};
  shade_vertices(state, batch, 0, batch.count, s.vertices);
  return s;
}

AttributeStream packed(const std::vector<float>& v, uint8_t size) {
  return {v.data(), size * sizeof(float), size};
}

VertexBatch batch_of(const std::vector<float>& positions, uint8_t size = 4) {
  VertexBatch batch;
  batch.position = packed(positions, size);
  batch.count = uint32_t(positions.size() / size);
  return batch;
}

DrawState perspective_state() {
  DrawState state;
  state.clip_from_object = {1.7, 0.1, 0.2,  0.3, -0.2, 2.1,   0.1,  -0.1,
                            0.3, 0.2, -1.1, -1,  0.5,  -0.25, -0.2, 0.125};
  state.viewport = {37, -11, 641, 479, 0.125, 0.875};
  return state;
}

std::vector<float> random_positions(uint32_t count, uint32_t seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<float> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-40, 40);
  std::vector<float> v(count * 4);
  for (size_t i = 0; i < v.size(); ++i)
    v[i] = i % 3 == 0 ? std::ldexp(mantissa(rng), exponent(rng)) : mantissa(rng);
  const float inf = std::numeric_limits<float>::infinity();
  v[5] = inf, v[17] = std::nanf(""), v[30] = -inf, v[43] = 1e-42f;
  return v;
}

// A view as good as any: the tests of layout only need a texture to be on.
std::shared_ptr<const TextureView> some_view() { return std::make_shared<TextureView>(); }

TEST(VertexStage, IdentityMapsCornersOfTheViewVolumeToCornersOfTheViewport) {
  DrawState state;
  state.viewport = {10, 20, 100, 50, 0, 1};
  const std::vector<float> v = {-1, -1, -1, 1, 1, 1, 1, 1, 0, 0, 0, 1, -3, -3, -3, 3};
  const Shaded s = shade(state, batch_of(v));
  const int expected[4][2] = {{10, 20}, {110, 70}, {60, 45}, {10, 20}};
  const double depth[4] = {0, 1, 0.5, 0};
  for (uint32_t i = 0; i < 4; ++i) {
    EXPECT_EQ(s.vertices.head(i).x, expected[i][0] * 256) << i;
    EXPECT_EQ(s.vertices.head(i).y, expected[i][1] * 256) << i;
    EXPECT_EQ(s.vertices.head(i).z, depth[i]) << i;
    EXPECT_EQ(s.vertices.outcodes[i], 0) << i;
  }
  EXPECT_EQ(s.vertices.head(3).inv_w, 1.0 / 3.0);
}

TEST(VertexStage, SnapsToTheNearestGridPointHalvesUpwards) {
  DrawState state;
  state.viewport = {0, 0, 512, 512, 0, 1};  // one unit of x is 65536 grid steps
  for (int steps = -9; steps <= 9; ++steps) {
    const float x = float(steps) / 4.0f / 65536.0f;
    const Shaded s = shade(state, batch_of({x, -x, 0, 1}));
    EXPECT_EQ(s.vertices.head(0).x, 65536 + int(std::floor(steps / 4.0 + 0.5))) << steps;
    EXPECT_EQ(s.vertices.head(0).y, 65536 + int(std::floor(-steps / 4.0 + 0.5))) << steps;
  }
}

using Real = long double;

uint16_t model_outcode(const ClipVertex& c, const Viewport& v) {
  if (!std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z) || !std::isfinite(c.w))
    return kOutNotFinite;
  unsigned code = 0;
  if (c.x < -c.w) code |= kOutLeft;
  if (c.x > c.w) code |= kOutRight;
  if (c.y < -c.w) code |= kOutBottom;
  if (c.y > c.w) code |= kOutTop;
  if (c.z < -c.w) code |= kOutNear;
  if (c.z > c.w) code |= kOutFar;
  if (c.w < 1e-30) code |= kOutW;
  const Real w = Real(c.w), half_width = Real(v.width) / 2, half_height = Real(v.height) / 2;
  const Real x = Real(c.x) * half_width + (Real(v.x) + half_width) * w;
  const Real y = Real(c.y) * half_height + (Real(v.y) + half_height) * w;
  if (x < kGuardBandMin * w) code |= kOutGuardLeft;
  if (x > kGuardBandMax * w) code |= kOutGuardRight;
  if (y < kGuardBandMin * w) code |= kOutGuardBottom;
  if (y > kGuardBandMax * w) code |= kOutGuardTop;
  return uint16_t(code);
}

void expect_clip_near(const DrawState& state, const float* position, const ClipVertex& c) {
  for (size_t r = 0; r < 4; ++r) {
    Real sum = 0, size = 0;
    for (size_t k = 0; k < 4; ++k) {
      const Real term = Real(state.clip_from_object[4 * k + r]) * Real(position[k]);
      sum += term, size += std::fabs(term);
    }
    if (!std::isfinite(size)) continue;
    EXPECT_NEAR((&c.x)[r], double(sum), double(size) * 1e-15);
  }
}

void expect_matches_model(const DrawState& state, const std::vector<float>& v, const Shaded& s) {
  const Viewport& view = state.viewport;
  for (uint32_t i = 0; i < s.vertices.count; ++i) {
    const ClipVertex& c = s.vertices.clip[i];
    expect_clip_near(state, &v[4 * i], c);
    ASSERT_EQ(s.vertices.outcodes[i], model_outcode(c, view)) << i;
    if (s.vertices.outcodes[i] & (kOutCutMask | kOutNotFinite)) continue;
    const Real w = Real(c.w), near = Real(view.depth_near);
    const Real x = (Real(c.x) / w + 1) * view.width / 2 + view.x;
    const Real y = (Real(c.y) / w + 1) * view.height / 2 + view.y;
    const Real z = (Real(c.z) / w + 1) / 2 * (Real(view.depth_far) - near) + near;
    const VertexHead& head = s.vertices.head(i);
    EXPECT_NEAR(double(head.x - x * 256), 0, 0.5000001) << i;
    EXPECT_NEAR(double(head.y - y * 256), 0, 0.5000001) << i;
    EXPECT_NEAR(head.z, double(z), 1e-14) << i;
    EXPECT_NEAR(head.inv_w * double(w), 1, 1e-15) << i;
  }
}

// What is worked out again is what the kernels had, to the bit.
void expect_places_are_of_clip_coordinates(const DrawState& state, const Shaded& s) {
  const WindowTransform t = make_window_transform(state.viewport);
  for (uint32_t i = 0; i < s.vertices.count; ++i) {
    if (s.vertices.outcodes[i] & (kOutCutMask | kOutNotFinite)) continue;
    const ClipVertex c = s.vertices.clip[i];
    const VertexHead& head = s.vertices.head(i);
    EXPECT_EQ(head.x, snap_coordinate(c.x, c.w, t.scale_x, t.offset_x)) << i;
    EXPECT_EQ(head.y, snap_coordinate(c.y, c.w, t.scale_y, t.offset_y)) << i;
    EXPECT_EQ(head.z, std::clamp(c.z / c.w * t.depth_scale + t.depth_offset, t.depth_low, t.depth_high)) << i;
    EXPECT_EQ(head.inv_w, 1 / c.w) << i;
  }
}

TEST(VertexStage, AgreesWithTheModel) {
  DrawState state = perspective_state();
  const std::vector<float> v = random_positions(5000, 7);
  expect_matches_model(state, v, shade(state, batch_of(v)));
  state.viewport = {-20000, 30000, 16384, 7, 1, 0};  // nowhere near the guard band: the slow kind of group
  expect_matches_model(state, v, shade(state, batch_of(v)));
}

TEST(VertexStage, AnyRangeAndEveryLevelGivesTheSameBytes) {
  DrawState state = perspective_state();
  state.texture.view = some_view();
  state.texture.matrix_is_identity = false;
  state.texture.matrix = {2, 0.1, 0, 0.2, 0.3, -1, 0, 0.1, 0, 0, 1, 0, 0.5, 0.25, 0, 1};
  const std::vector<float> v = random_positions(1003, 3), attributes = random_positions(1003, 5);
  VertexBatch batch = batch_of(v);
  batch.color = batch.tex_coord = packed(attributes, 4);
  const std::string before(isa_name());
  ASSERT_TRUE(set_isa("scalar") || set_isa("neon"));
  const Shaded reference = shade(state, batch);
  std::istringstream levels{std::string(isa_available())};
  for (std::string level; levels >> level;) {
    ASSERT_TRUE(set_isa(level));
    Shaded s = shade(state, batch);
    std::fill(s.storage.begin(), s.storage.end(), 0);
    for (uint32_t first = 0, n = 1; first < batch.count; first += n, n = n * 2 + 1) {
      shade_vertices(state, batch, first, std::min(n, batch.count - first), s.vertices);
    }
    EXPECT_EQ(s.storage, reference.storage) << level;
    EXPECT_EQ(s.vertices.outcodes, reference.vertices.outcodes) << level;
    expect_places_are_of_clip_coordinates(state, s);
  }
  set_isa(before);
}

TEST(VertexStage, MovingTheViewportMovesTheGridPointsExactly) {
  DrawState state = perspective_state();
  const std::vector<float> v = random_positions(2000, 11);
  const Shaded here = shade(state, batch_of(v));
  state.viewport.x += 3998, state.viewport.y += 3998;
  const Shaded there = shade(state, batch_of(v));
  for (uint32_t i = 0; i < here.vertices.count; ++i) {
    if ((here.vertices.outcodes[i] | there.vertices.outcodes[i]) & (kOutCutMask | kOutNotFinite)) continue;
    EXPECT_EQ(here.vertices.head(i).x + 3998 * 256, there.vertices.head(i).x);
    EXPECT_EQ(here.vertices.head(i).y + 3998 * 256, there.vertices.head(i).y);
  }
}

TEST(VertexStage, ColoursAreClampedAndNaNIsZero) {
  const float nan = std::nanf(""), inf = std::numeric_limits<float>::infinity();
  const std::vector<float> colors = {-1, 0.25f, 2, nan, inf, -inf, 1, -0.0f};
  const std::vector<float> origin(6, 0.0f);
  VertexBatch batch = batch_of(origin, 3);
  batch.color = packed(colors, 4);
  const Shaded s = shade(DrawState{}, batch);
  ASSERT_EQ(s.vertices.layout.color, 0);
  const float expected[8] = {0, 0.25f, 1, 0, 1, 0, 1, 0};
  EXPECT_EQ(0, std::memcmp(s.vertices.attributes(0), expected, 16));
  EXPECT_EQ(0, std::memcmp(s.vertices.attributes(1), expected + 4, 16));
}

TEST(VertexStage, TextureCoordinatesGoThroughTheMatrixAndStayFinite) {
  DrawState state;
  state.texture.view = some_view();
  const float nan = std::nanf(""), inf = std::numeric_limits<float>::infinity();
  const std::vector<float> coords = {0.5f, 3, inf, nan, -inf, -2};
  const std::vector<float> origin(9, 0.0f);
  VertexBatch batch = batch_of(origin, 3);
  batch.tex_coord = packed(coords, 2);
  Shaded s = shade(state, batch);
  EXPECT_EQ(s.vertices.layout.attribute_count, 2);
  EXPECT_EQ(s.vertices.attributes(0)[1], 3.0f);
  EXPECT_EQ(s.vertices.attributes(1)[0], 1e30f);
  EXPECT_EQ(s.vertices.attributes(1)[1], 0.0f);
  EXPECT_EQ(s.vertices.attributes(2)[0], -1e30f);
  state.texture.matrix = {2, 0, 0, 0, 0, 4, 0, 0.5, 0, 0, 1, 0, 0.25, 0, 0, 1};  // q = 0.5 t + 1
  state.texture.matrix_is_identity = false;
  s = shade(state, batch);
  ASSERT_TRUE(s.vertices.layout.projective);
  EXPECT_EQ(s.vertices.attributes(0)[0], 1.25f);
  EXPECT_EQ(s.vertices.attributes(0)[1], 12.0f);
  EXPECT_EQ(s.vertices.attributes(0)[2], 2.5f);
}

TEST(VertexLayoutChoice, LeavesOutWhatDoesNotVary) {
  DrawState state;
  const std::vector<float> same = {0.5f, 2, 0, 0.5f, 2, 0}, differ = {0.5f, 2, 0, 0.5f, 2, 1};
  const std::vector<float> origin(6, 0.0f);
  VertexBatch batch = batch_of(origin, 3);
  EXPECT_EQ(choose_layout(state, batch).constant_color, (Color{1, 1, 1, 1}));
  batch.color = packed(same, 3);
  EXPECT_EQ(choose_layout(state, batch).color, -1);
  EXPECT_EQ(choose_layout(state, batch).constant_color, (Color{0.5f, 1, 0, 1}));
  batch.color = packed(differ, 3);
  EXPECT_EQ(choose_layout(state, batch).attribute_count, 4);
  batch.color.stride = 0;
  EXPECT_EQ(choose_layout(state, batch).color, -1);
  const std::vector<float> flat = {1, 2, 3, 1, 4, 5, 6, 1}, bent = {1, 2, 3, 1, 4, 5, 6, 0.5f};
  batch.tex_coord = packed(flat, 4);
  EXPECT_EQ(choose_layout(state, batch).tex_coord, -1) << "no texture is on";
  state.texture.view = some_view();
  EXPECT_FALSE(choose_layout(state, batch).projective);
  batch.tex_coord = packed(bent, 4);
  EXPECT_TRUE(choose_layout(state, batch).projective);
}

}  // namespace
}  // namespace halfspace::raster
