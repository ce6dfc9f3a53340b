// 8-bit blending rounds once. Against exact integers.
#include <gtest/gtest.h>

#include <numeric>

#include "tests/oracle/fragment.h"
#include "tests/support/canvas.h"
#include "tests/support/random.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 256;  // one pixel a byte value in x and in y

Color from_bytes(int r, int g, int b, int a) {
  return {float(r) / 255, float(g) / 255, float(b) / 255, float(a) / 255};
}

// 256 quads one pixel wide, side by side or one above the other, of colours given by a function of 0 .. 255.
template <typename ColorOf>
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

DrawState state_with(BlendFactor src, BlendFactor dst) {
  DrawState state = plain_state(kSize, kSize);
  state.blend = {true, src, dst};
  return state;
}

// All (s, d, a) of s a + d (1 - a); three channels a pass. HALFSPACE_LONG_TESTS: all 2^24.
TEST(Blend, SourceAlphaOfEveryByte) {
  Canvas canvas(kSize, kSize);
  const auto columns = stripes(true, [](int d) { return from_bytes(d, 255 - d, d ^ 0x55, d); });
  const BlendState blend{true, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha};
  // No common factor with 255, or the sums that are hardest to round never occur.
  std::vector<int> alphas{0, 1, 2, 7, 43, 77, 101, 127, 128, 151, 202, 254, 255};
  if (long_tests()) {
    alphas.resize(256);
    std::iota(alphas.begin(), alphas.end(), 0);
  }
  for (const int a : alphas) {
    canvas.draw(plain_state(kSize, kSize), Primitive::quads, columns);
    canvas.draw(state_with(blend.src, blend.dst), Primitive::quads,
                stripes(false, [a](int s) { return from_bytes(s, s, (s * 7) & 255, a); }));
    const Picture picture = canvas.read();
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const uint8_t s[4] = {uint8_t(y), uint8_t(y), uint8_t(y * 7), uint8_t(a)};
        const uint8_t d[4] = {uint8_t(x), uint8_t(255 - x), uint8_t(x ^ 0x55), uint8_t(x)};
        for (int c = 0; c < 4; ++c) {
          ASSERT_EQ(int(picture.pixel(x, y)[c]), int(oracle::blend(blend, s, d, c)))
              << "s " << int(s[c]) << ", d " << int(d[c]) << ", a " << a << ", component " << c;
        }
      }
    }
  }
}

// Every pair of factors over bytes taken at random.
TEST(Blend, EveryPairOfFactors) {
  Random random(1);
  std::vector<std::array<uint8_t, 4>> source(kSize), destination(kSize);
  for (int round = 0; round < (long_tests() ? 20 : 1); ++round) {
    for (int i = 0; i < kSize; ++i) {
      for (size_t c = 0; c < 4; ++c) {
        source[size_t(i)][c] = uint8_t(random.bits());
        destination[size_t(i)][c] = uint8_t(random.bits());
      }
      // The ends of the range often.
      if (i % 8 == 0) source[size_t(i)].fill(i % 16 ? 255 : 0);
      if (i % 8 == 1) destination[size_t(i)].fill(i % 16 == 1 ? 255 : 0);
    }
    const auto color = [](const std::array<uint8_t, 4>& b) { return from_bytes(b[0], b[1], b[2], b[3]); };
    const auto columns = stripes(true, [&](int i) { return color(destination[size_t(i)]); });
    const auto rows = stripes(false, [&](int i) { return color(source[size_t(i)]); });
    Canvas canvas(kSize, kSize);
    for (int src = 0; src < 11; ++src) {
      for (int dst = 0; dst < 11; ++dst) {
        const BlendState blend{true, BlendFactor(src), BlendFactor(dst)};
        canvas.draw(plain_state(kSize, kSize), Primitive::quads, columns);
        canvas.draw(state_with(blend.src, blend.dst), Primitive::quads, rows);
        const Picture picture = canvas.read();
        for (int y = 0; y < kSize; ++y) {
          for (int x = 0; x < kSize; ++x) {
            const uint8_t *s = source[size_t(y)].data(), *d = destination[size_t(x)].data();
            for (int c = 0; c < 4; ++c) {
              ASSERT_EQ(int(picture.pixel(x, y)[c]), int(oracle::blend(blend, s, d, c)))
                  << "factors " << src << ", " << dst << ", component " << c << ", s " << int(s[0]) << " "
                  << int(s[1]) << " " << int(s[2]) << " " << int(s[3]) << ", d " << int(d[0]) << " "
                  << int(d[1]) << " " << int(d[2]) << " " << int(d[3]);
            }
          }
        }
      }
    }
  }
}

TEST(Blend, ThousandPassesAtAlphaZeroChangeNothing) {
  Canvas canvas(kSize, kSize);
  canvas.draw(plain_state(kSize, kSize), Primitive::quads,
              stripes(true, [](int d) { return from_bytes(d, 255 - d, d ^ 0x55, d); }));
  const Picture before = canvas.read();
  const DrawState state = state_with(BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha);
  for (int i = 0; i < 1000; ++i) {
    canvas.draw_plain(state, Primitive::quads, snapped_quad(0, 0, 256 * kSize, 256 * kSize, kSize),
                      from_bytes(i & 255, 255, 3, 0));
  }
  EXPECT_EQ(first_difference(before, canvas.read()), "");
}

// Spec 4.1.4. A byte's alpha equals the reference that was made from the same byte.
TEST(AlphaTest, ComparesBytesExactly) {
  for (int f = 0; f < 8; ++f) {
    for (int reference : {0, 1, 77, 127, 128, 200, 254, 255}) {
      Canvas canvas(kSize, 1);
      DrawState state = plain_state(kSize, kSize);
      state.alpha_test = {true, CompareFunc(f), float(reference) / 255};
      canvas.draw(state, Primitive::quads, stripes(true, [](int a) { return from_bytes(255, 255, 255, a); }));
      const Picture picture = canvas.read();
      for (int a = 0; a < kSize; ++a) {
        ASSERT_EQ(picture.pixel(a, 0)[0] == 255, oracle::compare(CompareFunc(f), a, reference))
            << "function " << f << ", alpha " << a << ", reference " << reference;
      }
    }
  }
}

// A fragment that fails leaves depth alone.
TEST(AlphaTest, ComesBeforeDepth) {
  Canvas canvas(kSize, 1);
  DrawState state = plain_state(kSize, kSize);
  state.depth.test = true;
  state.alpha_test = {true, CompareFunc::greater, 0.5f};
  canvas.draw(state, Primitive::quads, stripes(true, [](int a) { return from_bytes(255, 255, 255, a); }));
  const Picture picture = canvas.read();
  for (int a = 0; a < kSize; ++a) ASSERT_EQ(picture.depth_at(a, 0) != (1u << 24) - 1, a > 127) << a;
}

// Spec 4.2.2, with and without blending.
TEST(ColorMask, KeepsWhatItMasks) {
  for (int mask = 0; mask < 16; ++mask) {
    for (bool blend : {false, true}) {
      Canvas canvas(8, 8);
      canvas.clear(from_bytes(10, 20, 30, 40));
      DrawState state = plain_state(8, 8);
      state.color_mask = {(mask & 1) != 0, (mask & 2) != 0, (mask & 4) != 0, (mask & 8) != 0};
      if (blend) state.blend = {true, BlendFactor::one, BlendFactor::one};
      canvas.draw_plain(state, Primitive::quads, snapped_quad(0, 0, 2048, 2048, 8),
                        from_bytes(100, 110, 120, 130));
      const Picture picture = canvas.read();
      for (int c = 0; c < 4; ++c) {
        const int old = 10 * (c + 1), drawn = 100 + 10 * c + (blend ? old : 0);
        EXPECT_EQ(int(picture.pixel(3, 5)[c]), mask >> c & 1 ? drawn : old) << "mask " << mask;
      }
    }
  }
}

}  // namespace
}  // namespace halfspace::test
