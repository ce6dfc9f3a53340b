// The stencil test, pixel by pixel against its definition (spec 4.1.5), with and without a depth test behind
// it.
#include <gtest/gtest.h>

#include <array>

#include "tests/support/canvas.h"
#include "tests/support/random.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 128;  // four tiles

struct Pixel {
  uint8_t stencil;
  float depth;
  bool drawn = false;
};

bool passes(CompareFunc func, double a, double b) {
  switch (func) {
    case CompareFunc::never:
      return false;
    case CompareFunc::less:
      return a < b;
    case CompareFunc::equal:
      return a == b;
    case CompareFunc::less_equal:
      return a <= b;
    case CompareFunc::greater:
      return a > b;
    case CompareFunc::not_equal:
      return a != b;
    case CompareFunc::greater_equal:
      return a >= b;
    case CompareFunc::always:
      break;
  }
  return true;
}

uint8_t changed(StencilOp op, int value, const StencilState& s) {
  const int results[] = {value,      0, s.reference, std::min(value + 1, 255), std::max(value - 1, 0),
                         255 - value};
  return uint8_t((results[int(op)] & s.write_mask) | (value & ~s.write_mask));
}

// One fragment of depth `z`, as the specification has it.
void define(const DrawState& state, float z, Pixel& pixel) {
  const StencilState& s = state.stencil;
  if (s.test && !passes(s.func, s.reference & s.compare_mask, pixel.stencil & s.compare_mask)) {
    pixel.stencil = changed(s.fail, pixel.stencil, s);
    return;
  }
  const bool seen = !state.depth.test || passes(state.depth.func, double(z), double(pixel.depth));
  if (s.test) pixel.stencil = changed(seen ? s.depth_pass : s.depth_fail, pixel.stencil, s);
  if (!seen) return;
  if (state.depth.test && state.depth.write) pixel.depth = z;
  pixel.drawn = true;
}

// Columns of a width that no block has, each with a stencil value and a depth of its own.
constexpr int kColumn = 3;
uint8_t stencil_of(int x) { return uint8_t(x / kColumn * 37); }
float depth_of(int x) {
  return float(x / kColumn * 5 % 8 + 1) / 16;
}  // exact in 24 bits but for rounding, alike

class Board {
 public:
  explicit Board(bool fuse) : canvas_(kSize, kSize, 2, ColorFormat::rgba8, fuse) {
    for (int x = 0; x < kSize; ++x) {
      ClearCommand command;
      command.stencil = command.depth = true;
      command.stencil_value = stencil_of(x);
      command.depth_value = double(depth_of(x));
      command.scissor_test = true;
      command.scissor = {x, 0, x + 1, kSize};
      canvas_.device().clear(command);
    }
  }
  // White, all over.
  void draw(const DrawState& state, float z) {
    const float clip_z = z * 2 - 1;
    const std::array<Vertex, 3> corners{{{-1, -1, clip_z}, {3, -1, clip_z}, {-1, 3, clip_z}}};
    canvas_.draw_plain(state, Primitive::triangles, corners, {1, 1, 1, 1});
  }
  std::vector<uint8_t> stencil() {
    std::vector<uint8_t> values(kSize * kSize);
    canvas_.device().read_stencil({0, 0, kSize, kSize}, values.data());
    return values;
  }
  Picture picture() { return canvas_.read(); }

 private:
  Canvas canvas_;
};

DrawState random_state(Random& random) {
  DrawState state = plain_state(kSize, kSize);
  StencilState& s = state.stencil;
  s.test = true;
  s.func = CompareFunc(random.integer(0, 7));
  s.reference = uint8_t(random.bits());
  s.compare_mask = random.integer(0, 2) == 0 ? uint8_t(random.bits()) : 0xff;
  s.write_mask = random.integer(0, 2) == 0 ? uint8_t(random.bits()) : 0xff;
  s.fail = StencilOp(random.integer(0, 5));
  s.depth_fail = StencilOp(random.integer(0, 5));
  s.depth_pass = StencilOp(random.integer(0, 5));
  state.depth = {random.integer(0, 3) != 0, CompareFunc(random.integer(0, 7)), random.integer(0, 1) == 0};
  if (random.integer(0, 3) == 0) state.color_mask = {false, false, false, false};
  if (random.integer(0, 3) == 0) state.alpha_test = {true, CompareFunc::greater, 0.5f};  // all pass
  if (random.integer(0, 5) == 0) state.alpha_test = {true, CompareFunc::less, 0.5f};     // none does
  return state;
}

void check(Board& board, const std::vector<Pixel>& expected, int seed) {
  const auto stencil = board.stencil();
  const Picture picture = board.picture();
  for (int y = 0; y < kSize; y += 5) {
    for (int x = 0; x < kSize; ++x) {
      const Pixel& pixel = expected[size_t(x)];
      ASSERT_EQ(int(stencil[size_t(y * kSize + x)]), int(pixel.stencil)) << seed << " at " << x << "," << y;
      ASSERT_EQ(int(picture.pixel(x, y)[1]), pixel.drawn ? 255 : 0) << seed << " at " << x << "," << y;
      const auto depth = uint32_t(double(pixel.depth) * 16777215.0 + 0.5);
      ASSERT_EQ(picture.depth_at(x, y), depth) << seed << " at " << x << "," << y;
    }
  }
}

// Three draws, each of its own state, at every level of code.
TEST(Stencil, IsAsDefined) {
  for (const std::string& isa : isa_levels()) {
    const IsaScope scope(isa);
    for (int seed = 0; seed < (long_tests() ? 2000 : 120); ++seed) {
      Random random{uint64_t(seed)};
      Board board(seed % 2 == 0);
      std::vector<Pixel> pixels;
      for (int x = 0; x < kSize; ++x) pixels.push_back({stencil_of(x), depth_of(x)});
      for (int i = 0; i < 3; ++i) {
        const DrawState state = random_state(random);
        const float z = float(random.integer(0, 9)) / 16;
        board.draw(state, z);
        const bool killed = state.alpha_test.enabled && state.alpha_test.func == CompareFunc::less;
        for (Pixel& pixel : pixels) {
          const bool drawn = pixel.drawn;
          pixel.drawn = false;
          if (!killed) define(state, z, pixel);
          pixel.drawn = drawn || (pixel.drawn && !state.color_mask.none());
        }
      }
      ASSERT_NO_FATAL_FAILURE(check(board, pixels, seed)) << isa;
    }
  }
}

// Coarse z must not swallow what a hidden fragment does to its stencil value.
TEST(Stencil, HiddenBlocksAreMarked) {
  Canvas canvas(kSize, kSize);
  canvas.clear({0, 0, 0, 0}, 0.25);
  DrawState state = plain_state(kSize, kSize);
  state.depth = {true, CompareFunc::less, true};
  state.stencil.test = true;
  state.stencil.depth_fail = StencilOp::increment;
  const std::array<Vertex, 3> corners{{{-1, -1, 0.5f}, {3, -1, 0.5f}, {-1, 3, 0.5f}}};
  canvas.draw_plain(state, Primitive::triangles, corners, {1, 1, 1, 1});
  std::vector<uint8_t> values(kSize * kSize);
  canvas.device().read_stencil({0, 0, kSize, kSize}, values.data());
  EXPECT_EQ(values, std::vector<uint8_t>(kSize * kSize, 1));
  // And where nothing is marked, nothing of a hidden block is shaded.
  const uint64_t before = canvas.device().statistics().fragments;
  state.stencil.depth_fail = StencilOp::keep;
  state.stencil.depth_pass = StencilOp::zero;
  canvas.draw_plain(state, Primitive::triangles, corners, {1, 1, 1, 1});
  canvas.device().finish();
  EXPECT_EQ(canvas.device().statistics().fragments, before);
}

// What the stencil test keeps out does not hide what comes later.
TEST(Stencil, RefusedFragmentsLeaveNoCoarseDepth) {
  Canvas canvas(kSize, kSize);
  DrawState state = plain_state(kSize, kSize);
  state.depth = {true, CompareFunc::less, true};
  state.stencil.test = true;
  state.stencil.func = CompareFunc::never;
  const auto cover = [&](float z) {
    const std::array<Vertex, 3> corners{{{-1, -1, z}, {3, -1, z}, {-1, 3, z}}};
    canvas.draw_plain(state, Primitive::triangles, corners, {1, 1, 1, 1});
  };
  state.stencil.fail = StencilOp::increment;
  cover(-0.5f);
  EXPECT_EQ(int(canvas.read().pixel(40, 40)[0]), 0);
  state.stencil.test = false;
  cover(0.5f);
  const Picture picture = canvas.read();
  EXPECT_EQ(picture.rgba, std::vector<uint8_t>(picture.rgba.size(), 255));
}

// Clears under a mask and a scissor.
TEST(Stencil, ClearsArePartOfThePicture) {
  Canvas canvas(kSize, kSize);
  std::vector<uint8_t> expected(kSize * kSize);
  Random random(3);
  for (int i = 0; i < 40; ++i) {
    ClearCommand command;
    command.stencil = true;
    command.stencil_value = uint8_t(random.bits());
    command.stencil_mask = i % 3 == 0 ? uint8_t(random.bits()) : 0xff;
    command.scissor_test = i % 4 != 0;
    const int x = int(random.integer(-9, kSize)), y = int(random.integer(-9, kSize));
    command.scissor = {x, y, x + int(random.integer(0, 90)), y + int(random.integer(0, 90))};
    canvas.device().clear(command);
    for (int py = 0; py < kSize; ++py) {
      for (int px = 0; px < kSize; ++px) {
        const Rect& r = command.scissor;
        if (command.scissor_test && (px < r.x0 || px >= r.x1 || py < r.y0 || py >= r.y1)) continue;
        uint8_t& value = expected[size_t(py * kSize + px)];
        value = uint8_t((command.stencil_value & command.stencil_mask) | (value & ~command.stencil_mask));
      }
    }
    std::vector<uint8_t> values(kSize * kSize);
    canvas.device().read_stencil({0, 0, kSize, kSize}, values.data());
    ASSERT_EQ(values, expected) << i;
  }
}

// Pending draws that mark stencil are not dropped by a clear of colour and depth.
TEST(Stencil, AClearOfColourAndDepthKeepsPendingMarks) {
  Canvas canvas(kSize, kSize);
  DrawState state = plain_state(kSize, kSize);
  state.stencil.test = true;
  state.stencil.depth_pass = StencilOp::invert;
  const std::array<Vertex, 3> corners{{{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}}};
  canvas.draw_plain(state, Primitive::triangles, corners, {1, 1, 1, 1});
  canvas.clear();
  std::vector<uint8_t> values(kSize * kSize);
  canvas.device().read_stencil({0, 0, kSize, kSize}, values.data());
  EXPECT_EQ(values, std::vector<uint8_t>(kSize * kSize, 255));
}

}  // namespace
}  // namespace halfspace::test
