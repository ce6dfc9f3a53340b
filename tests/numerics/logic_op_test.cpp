// Logical operations: all 16, over every pair of bytes.
#include <gtest/gtest.h>

#include <array>

#include "tests/support/canvas.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 256;  // one pixel a byte value in x and in y

Color from_byte(int v) {
  return {float(v) / 255, float(255 - v) / 255, float(v ^ 0x5a) / 255, float(v * 3 & 255) / 255};
}

template <class ColorOf>
std::vector<Vertex> stripes(bool columns, const ColorOf& color_of) {
  std::vector<Vertex> vertices;
  for (int i = 0; i < kSize; ++i) {
    const int64_t low = 256 * i, high = low + 256, end = 256 * kSize;
    const auto quad = columns ? snapped_quad(low, 0, high, end, kSize, 0, color_of(i))
                              : snapped_quad(0, low, end, high, kSize, 0, color_of(i));
    vertices.insert(vertices.end(), quad.begin(), quad.end());
  }
  return vertices;
}

// Table 4.2, a bit at a time: bit (s, d) of the operation's number says what becomes of source s over
// destination d.
bool bit_of(LogicOp op, bool s, bool d) {
  constexpr std::array<const char*, 16> kTable = {// results for (s,d) = (0,0) (0,1) (1,0) (1,1)
                                                  "0000", "0001", "0010", "0011", "0100", "0101",
                                                  "0110", "0111", "1000", "1001", "1010", "1011",
                                                  "1100", "1101", "1110", "1111"};
  return kTable[size_t(op)][size_t(s) * 2 + size_t(d)] == '1';
}

int combined(LogicOp op, int s, int d) {
  int result = 0;
  for (int bit = 0; bit < 8; ++bit)
    result |= int(bit_of(op, (s >> bit & 1) != 0, (d >> bit & 1) != 0)) << bit;
  return result;
}

void check_all(Canvas& canvas, bool fuse) {
  for (int op = 0; op < 16; ++op) {
    canvas.draw(plain_state(kSize, kSize), Primitive::quads, stripes(true, from_byte));
    DrawState state = plain_state(kSize, kSize);
    state.logic_op = {true, LogicOp(op)};
    // Blending gives way.
    state.blend = {fuse, BlendFactor::zero, BlendFactor::zero};
    canvas.draw(state, Primitive::quads, stripes(false, from_byte));
    const Picture picture = canvas.read();
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const int s[4] = {y, 255 - y, y ^ 0x5a, y * 3 & 255}, d[4] = {x, 255 - x, x ^ 0x5a, x * 3 & 255};
        for (int c = 0; c < 4; ++c)
          ASSERT_EQ(int(picture.pixel(x, y)[c]), combined(LogicOp(op), s[c], d[c]))
              << op << " at " << x << "," << y;
      }
    }
  }
}

TEST(LogicOp, EveryOperationOnEveryPairOfBytes) {
  for (const bool fuse : {true, false}) {
    Canvas canvas(kSize, kSize, 1, ColorFormat::rgba8, fuse);
    ASSERT_NO_FATAL_FAILURE(check_all(canvas, fuse));
  }
}

TEST(LogicOp, WideBuffersHoldBytesExactly) {
  Canvas canvas(kSize, kSize, 1, ColorFormat::rgba32f);
  check_all(canvas, true);
}

// Drawn twice, XOR leaves nothing behind; the masked channels keep out.
TEST(LogicOp, XorTwiceIsNothing) {
  Canvas canvas(kSize, kSize);
  canvas.draw(plain_state(kSize, kSize), Primitive::quads, stripes(true, from_byte));
  const Picture before = canvas.read();
  DrawState state = plain_state(kSize, kSize);
  state.logic_op = {true, LogicOp::xor_};
  state.color_mask.b = false;
  canvas.draw(state, Primitive::quads, stripes(false, from_byte));
  const Picture between = canvas.read();
  EXPECT_NE(between, before);
  EXPECT_EQ(between.pixel(17, 99)[2], before.pixel(17, 99)[2]);
  canvas.draw(state, Primitive::quads, stripes(false, from_byte));
  EXPECT_EQ(canvas.read(), before);
}

}  // namespace
}  // namespace halfspace::test
