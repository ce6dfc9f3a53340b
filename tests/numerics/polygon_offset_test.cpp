// Polygon offset (spec 3.5.5): exactly factor * m + units steps of the depth buffer.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/canvas.h"
#include "tests/support/random.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 32;
constexpr double kSteps = 16777215;

std::vector<Vertex> random_triangle(Random& random) {
  std::vector<Vertex> v;
  for (int k = 0; k < 3; ++k)
    v.push_back(snapped_vertex(random.integer(0, kSize * 256), random.integer(0, kSize * 256), kSize,
                               random.real(-0.9f, 0.9f)));
  return v;
}

// Twice the area, in pixels squared, and the depth's slope: the greater of |dz/dx| and |dz/dy|, a pixel,
// depth in [0, 1].
struct Slope {
  double area, m;
};
Slope slope_of(const std::vector<Vertex>& v) {
  double x[3], y[3], z[3];
  for (size_t k = 0; k < 3; ++k) {
    x[k] = (double(v[k].x) + 1) * kSize / 2, y[k] = (double(v[k].y) + 1) * kSize / 2;
    z[k] = (double(v[k].z) + 1) / 2;
  }
  const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  const double gx = ((z[1] - z[0]) * (y[2] - y[0]) - (z[2] - z[0]) * (y[1] - y[0])) / area;
  const double gy = ((z[2] - z[0]) * (x[1] - x[0]) - (z[1] - z[0]) * (x[2] - x[0])) / area;
  return {std::fabs(area), std::max(std::fabs(gx), std::fabs(gy))};
}

DrawState depth_state(CompareFunc func) {
  DrawState state = plain_state(kSize, kSize);
  state.depth = {true, func, true};
  return state;
}

Picture draw(const DrawState& state, const std::vector<Vertex>& v, Primitive mode = Primitive::triangles) {
  Canvas canvas(kSize, kSize);
  canvas.draw(state, mode, v);
  return canvas.read();
}

// units = 1: no ties with the plane itself; units = -1: always in front of it.
TEST(PolygonOffset, UnitsAreStepsOfTheDepthBuffer) {
  Random random(1);
  const int rounds = long_tests() ? 10000 : 1000;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<Vertex> v = random_triangle(random);
    const Picture flat = draw(depth_state(CompareFunc::always), v);
    for (int units : {1, -1, 1000}) {
      DrawState state = depth_state(CompareFunc::always);
      state.polygon.offset_fill = true;
      state.polygon.offset_units = float(units);
      const Picture moved = draw(state, v);
      for (int i = 0; i < kSize * kSize; ++i) {
        if (flat.rgba[4 * size_t(i)] == 0) continue;
        const int64_t expected = std::clamp<int64_t>(int64_t{flat.depth[size_t(i)]} + units, 0, 16777215);
        ASSERT_EQ(int64_t{moved.depth[size_t(i)]}, expected) << "round " << round << ", units " << units;
      }
    }
  }
}

TEST(PolygonOffset, FactorIsOfTheSlope) {
  Random random(2);
  for (int round = 0; round < 500; ++round) {
    const std::vector<Vertex> v = random_triangle(random);
    const Slope slope = slope_of(v);
    if (slope.area < 8) continue;  // where snapping is a part of the slope
    DrawState state = depth_state(CompareFunc::always);
    const Picture flat = draw(state, v);
    state.polygon.offset_fill = true;
    state.polygon.offset_factor = 0.5f;
    state.polygon.offset_units = 3;
    const Picture moved = draw(state, v);
    const double expected = 0.5 * slope.m * kSteps + 3;
    for (int i = 0; i < kSize * kSize; ++i) {
      if (flat.rgba[4 * size_t(i)] == 0 || moved.depth[size_t(i)] == 16777215) continue;
      // Both depths are rounded; vertices are given in floats.
      const double difference = double(moved.depth[size_t(i)]) - double(flat.depth[size_t(i)]);
      ASSERT_NEAR(difference, expected, 1.01 + expected * 1e-5) << "round " << round;
    }
  }
}

// Edge-on or nearly: slopes are huge or undefined, depth stays in its range, and what lies beyond it passes
// as 1.
TEST(PolygonOffset, EdgeOnAndBeyondTheRange) {
  for (float factor : {1.0f, -1.0f, 1e30f, -1e30f, HUGE_VALF, NAN}) {
    for (int64_t width : {0, 1, 2}) {
      const std::vector<Vertex> v{snapped_vertex(5 * 256 + 127, 0, kSize, -1),
                                  snapped_vertex(5 * 256 + 127 + width, 0, kSize, 1),
                                  snapped_vertex(5 * 256 + 127, 32 * 256, kSize, 0.5f)};
      DrawState state = depth_state(CompareFunc::always);
      state.polygon.offset_fill = state.polygon.offset_line = true;
      state.polygon.offset_factor = factor;
      for (uint32_t d : draw(state, v).depth) ASSERT_LE(d, 16777215u);
      state.polygon.front = state.polygon.back = PolygonMode::line;
      for (uint32_t d : draw(state, v).depth) ASSERT_LE(d, 16777215u);
    }
  }
  DrawState state = depth_state(CompareFunc::less_equal);
  state.polygon.offset_fill = true;
  state.polygon.offset_units = 1e9f;
  const Picture picture = draw(state, snapped_quad(0, 0, 32 * 256, 32 * 256, kSize, 0), Primitive::quads);
  for (int i = 0; i < kSize * kSize; ++i) {
    ASSERT_EQ(int(picture.rgba[4 * size_t(i)]), 255) << "depth 1 is not beyond a buffer cleared to 1";
    ASSERT_EQ(picture.depth[size_t(i)], 16777215u);
  }
}

// Offset of outlines and points is that of the polygon, and each mode has its own switch.
TEST(PolygonOffset, OfOutlinesAndPoints) {
  for (const PolygonMode mode : {PolygonMode::line, PolygonMode::point}) {
    DrawState state = depth_state(CompareFunc::always);
    state.polygon.front = state.polygon.back = mode;
    const std::vector<Vertex> v{snapped_vertex(2 * 256 + 128, 2 * 256 + 128, kSize, -0.5f),
                                snapped_vertex(26 * 256 + 128, 2 * 256 + 128, kSize, -0.5f),
                                snapped_vertex(2 * 256 + 128, 26 * 256 + 128, kSize, 0.25f)};
    const Picture flat = draw(state, v);
    state.polygon.offset_factor = 2;
    state.polygon.offset_units = -7;
    state.polygon.offset_fill = true;
    EXPECT_EQ(first_difference(flat, draw(state, v)), "") << "the switch of another mode";
    (mode == PolygonMode::line ? state.polygon.offset_line : state.polygon.offset_point) = true;
    const Picture moved = draw(state, v);
    const double expected = 2 * (0.375 / 24) * kSteps - 7;
    int seen = 0;
    for (int i = 0; i < kSize * kSize; ++i) {
      if (flat.rgba[4 * size_t(i)] == 0) continue;
      ++seen;
      ASSERT_NEAR(double(moved.depth[size_t(i)]) - double(flat.depth[size_t(i)]), expected, 1.01);
    }
    EXPECT_GE(seen, mode == PolygonMode::line ? 70 : 3);
  }
}

}  // namespace
}  // namespace halfspace::test
