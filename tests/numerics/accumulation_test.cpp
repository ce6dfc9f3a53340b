// The accumulation buffer against sums kept in double (spec 4.2.4).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/canvas.h"
#include "tests/support/random.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 100;  // no multiple of a tile

// Every pixel has a colour of its own.
std::vector<Vertex> mosaic(uint64_t seed) {
  Random random(seed);
  std::vector<Vertex> vertices;
  for (int64_t y = 0; y < kSize; y += 5) {
    for (int64_t x = 0; x < kSize; x += 7) {
      const auto byte = [&] { return float(random.integer(0, 255)) / 255; };
      const auto quad = snapped_quad(x * 256, y * 256, (x + 7) * 256, (y + 5) * 256, 128, 0,
                                     {byte(), byte(), byte(), byte()});
      vertices.insert(vertices.end(), quad.begin(), quad.end());
    }
  }
  return vertices;
}

struct Sums {
  std::vector<double> value = std::vector<double>(kSize * kSize * 4);
  template <class Change>
  void change(const Rect& rect, Change change) {
    for (int y = rect.y0; y < rect.y1; ++y)
      for (int x = rect.x0; x < rect.x1; ++x)
        for (int c = 0; c < 4; ++c) {
          double& sum = value[size_t((y * kSize + x) * 4 + c)];
          sum = std::clamp(change(sum, x, y, c), -1.0, 1.0);
        }
  }
};

constexpr Rect kAll{0, 0, kSize, kSize};

class AccumulationTest : public ::testing::TestWithParam<ColorFormat> {
 protected:
  AccumulationTest() : canvas_(kSize, kSize, 2, GetParam()) {}
  void draw(uint64_t seed) {
    DrawState state = plain_state(128, 128);
    canvas_.draw(state, Primitive::quads, mosaic(seed));
  }
  void accumulate(AccumOp op, float value, const Rect& rect = kAll, const ColorMask& mask = {}) {
    AccumCommand command;
    command.op = op;
    command.value = value;
    command.scissor_test = rect != kAll;
    command.scissor = rect;
    command.color_mask = mask;
    canvas_.device().accumulate(command);
  }
  Canvas canvas_;
};

// Sums err by half a unit of 1/32767 an operation; a byte of what comes back by that and its own half.
TEST_P(AccumulationTest, KeepsSums) {
  Random random(7);
  Sums sums;
  ClearCommand clear;
  clear.accum = true;
  clear.accum_value = {0.25f, -0.5f, 1, -1};
  canvas_.device().clear(clear);
  const double initial[4] = {0.25, -0.5, 1, -1};
  sums.change(kAll, [&](double, int, int, int c) { return initial[c]; });
  int operations = 0;
  for (int round = 0; round < 30; ++round) {
    draw(uint64_t(round));
    const Picture picture = canvas_.read();
    const auto color = [&](int x, int y, int c) { return picture.pixel(x, y)[c] / 255.0; };
    const Rect part = round % 3 == 0 ? Rect{13, 5, 71, 97} : kAll;
    const double value = double(random.real(-0.5f, 0.5f));
    const auto op = AccumOp(random.integer(0, 4));
    accumulate(op == AccumOp::return_ ? AccumOp::accum : op, float(value), part);
    sums.change(part, [&](double sum, int x, int y, int c) {
      switch (op) {
        case AccumOp::load:
          return value * color(x, y, c);
        case AccumOp::mult:
          return sum * value;
        case AccumOp::add:
          return sum + value;
        default:
          return sum + value * color(x, y, c);
      }
    });
    ++operations;
    const Rect shown = round % 2 == 0 ? Rect{0, 40, 64, 100} : kAll;
    const ColorMask mask{true, round % 4 != 0, true, round % 5 != 0};
    const double scale = 1.5;
    accumulate(AccumOp::return_, float(scale), shown, mask);
    const Picture back = canvas_.read();
    const bool on[4] = {mask.r, mask.g, mask.b, mask.a};
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const bool inside = x >= shown.x0 && x < shown.x1 && y >= shown.y0 && y < shown.y1;
        for (int c = 0; c < 4; ++c) {
          const int got = back.pixel(x, y)[c];
          if (!inside || !on[c]) {
            ASSERT_EQ(got, int(picture.pixel(x, y)[c]));
            continue;
          }
          const double sum = sums.value[size_t((y * kSize + x) * 4 + c)];
          const double expected = std::clamp(sum * scale, 0.0, 1.0) * 255;
          const double slack = 0.5 + 0.5 * operations * scale * 255 / 32767 + 1e-6;
          ASSERT_LE(std::fabs(got - expected), slack) << round << " at " << x << "," << y << "," << c;
        }
      }
    }
  }
}

// What is loaded whole comes back as it was, every byte.
TEST_P(AccumulationTest, LoadAndReturnAreExact) {
  draw(99);
  const Picture before = canvas_.read();
  accumulate(AccumOp::load, 1);
  canvas_.clear({0.5f, 0.5f, 0.5f, 0.5f});
  accumulate(AccumOp::return_, 1);
  EXPECT_EQ(canvas_.read().rgba, before.rgba);
}

TEST_P(AccumulationTest, SumsSaturateAndOddValuesDoNoHarm) {
  draw(1);
  for (const float value : {1e30f, -1e30f, INFINITY, -INFINITY, NAN}) {
    for (const AccumOp op : {AccumOp::load, AccumOp::accum, AccumOp::add, AccumOp::mult, AccumOp::return_})
      accumulate(op, value);
  }
  accumulate(AccumOp::add, 5);
  accumulate(AccumOp::add, -0.5f);  // from 1, not from 5
  accumulate(AccumOp::return_, 2);
  const Picture picture = canvas_.read();
  for (int c = 0; c < 4; ++c) EXPECT_EQ(int(picture.pixel(50, 50)[c]), 255);
  accumulate(AccumOp::return_, 1);
  EXPECT_EQ(int(canvas_.read().pixel(50, 50)[0]), 128);
}

INSTANTIATE_TEST_SUITE_P(Formats, AccumulationTest,
                         ::testing::Values(ColorFormat::rgba8, ColorFormat::rgba32f));

}  // namespace
}  // namespace halfspace::test
