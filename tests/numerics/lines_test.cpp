// Diamond exit against an oracle that takes spec 3.4.1 at its word: move both ends by a tiny amount, then
// intersect the segment with every open diamond, in integers wide enough to be exact.
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cstdlib>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "raster/tile/coverage.h"
#include "tests/support/canvas.h"

namespace halfspace::raster {
namespace {

using Pixels = std::set<std::pair<int, int>>;

// Coordinates are in 1/256 pixel, times 2^(2 * Bits); the ends move by (2^-Bits, 4^-Bits) of that unit, which
// is less than any distance that can occur between what is not equal.
template <class Int, int Bits>
struct Oracle {
  Int x0, y0, x1, y1;

  Oracle(int ax, int ay, int bx, int by)
      : x0(moved_x(ax)), y0(moved_y(ay)), x1(moved_x(bx)), y1(moved_y(by)) {}
  static Int scaled(int v) { return Int(v) * (Int(1) << (2 * Bits)); }
  static Int moved_x(int v) { return scaled(v) - (Int(1) << Bits); }
  static Int moved_y(int v) { return scaled(v) - Int(1); }

  // Cyrus and Beck: which t of the segment lie inside all four sides of the diamond.
  bool makes_fragment(int px, int py) const {
    const Int cx = scaled(px * 256 + 128), cy = scaled(py * 256 + 128), half = scaled(128);
    Int low_n = 0, low_d = 1, high_n = 1, high_d = 1;  // t in [0, 1] as fractions, denominators positive
    bool low_open = false, high_open = false, end_inside = true;
    for (int side = 0; side < 4; ++side) {
      const Int sx = side & 1 ? 1 : -1, sy = side & 2 ? 1 : -1;
      const Int start = half - (sx * (x0 - cx) + sy * (y0 - cy)),
                end = half - (sx * (x1 - cx) + sy * (y1 - cy));
      end_inside = end_inside && end > 0;
      if (start <= 0 && end <= 0) return false;
      if (start > 0 && end > 0) continue;
      const bool enters = start <= 0;
      const Int n = enters ? Int(-start) : start, d = enters ? Int(end - start) : Int(start - end);
      if (enters && n * low_d >= low_n * d) low_n = n, low_d = d, low_open = true;
      if (!enters && n * high_d <= high_n * d) high_n = n, high_d = d, high_open = true;
    }
    if (end_inside) return false;
    const Int gap = high_n * low_d - low_n * high_d;
    return low_open || high_open ? gap > 0 : gap >= 0;
  }
};

Pixels covered(int x0, int y0, int x1, int y1, int tile_x, int tile_y, const Rect& bounds) {
  TileCoverage coverage;
  cover_line({x0, y0, x1, y1}, 1, {}, tile_x, tile_y, bounds, bounds, coverage);
  Pixels pixels;
  for (int b = 0; b < 64; ++b) {
    if (!(coverage.touched >> b & 1)) continue;
    for (int i = 0; i < 64; ++i) {
      if (coverage.blocks[b] >> i & 1)
        pixels.insert({tile_x + b % 8 * 8 + i % 8, tile_y + b / 8 * 8 + i / 8});
    }
  }
  for (const std::string& isa : test::isa_levels()) {
    const test::IsaScope scope(isa);
    PixelList list;
    list_line({x0, y0, x1, y1}, tile_x, tile_y, bounds, list);
    Pixels listed;
    for (int i = 0; i < list.count; ++i) listed.insert({tile_x + list.x[i], tile_y + list.y[i]});
    EXPECT_EQ(listed.size(), size_t(list.count));
    EXPECT_EQ(listed, pixels) << isa;
  }
  return pixels;
}

constexpr Rect kEverywhere = {-100000, -100000, 100000, 100000};

// One line near pixel (24, 24) of tile 0; every pixel of its box and one ring around it is looked at.
::testing::AssertionResult matches_oracle(int x0, int y0, int x1, int y1) {
  const Oracle<__int128, 14> oracle(x0, y0, x1, y1);
  const Pixels pixels = covered(x0, y0, x1, y1, 0, 0, kEverywhere);
  size_t found = 0;
  for (int py = (std::min(y0, y1) >> 8) - 1; py <= (std::max(y0, y1) >> 8) + 1; ++py) {
    for (int px = (std::min(x0, x1) >> 8) - 1; px <= (std::max(x0, x1) >> 8) + 1; ++px) {
      const bool made = pixels.count({px, py}) != 0;
      if (made != oracle.makes_fragment(px, py)) {
        return ::testing::AssertionFailure()
               << "(" << x0 << "," << y0 << ")-(" << x1 << "," << y1 << ") pixel " << px << "," << py
               << (made ? " is extra" : " is missing");
      }
      found += made;
    }
  }
  if (found != pixels.size()) return ::testing::AssertionFailure() << "pixels far from the line";
  return ::testing::AssertionSuccess();
}

bool long_tests() {
  const char* value = std::getenv("HALFSPACE_LONG_TESTS");
  return value && *value == '1';
}

// Every phase of the start against every displacement of less than 8 pixels, both on the 1/16 grid: up to
// whole pixels these are all pairs of an 8x8 window. The short run takes every 97th.
TEST(DiamondExit, AllEndpointPairsOnASixteenthGrid) {
  const int step = long_tests() ? 1 : 97;
  constexpr int kBase = 24 * 256, kSide = 2 * 8 * 16;
  int number = 0;
  for (int phase = 0; phase < 256; ++phase) {
    const int x0 = kBase + phase % 16 * 16, y0 = kBase + phase / 16 * 16;
    for (; number < kSide * kSide; number += step) {
      const int dx = (number % kSide - kSide / 2) * 16, dy = (number / kSide - kSide / 2) * 16;
      ASSERT_TRUE(matches_oracle(x0, y0, x0 + dx, y0 + dy));
    }
    number -= kSide * kSide;
  }
}

TEST(DiamondExit, EndpointsOnTheFullGridAndOnDiamondEdges) {
  std::mt19937 rng(5);
  for (int n = 0; n < 100000; ++n) {
    const auto near = [&](int center) {
      return center * 256 + int(rng() % 5) * 64 + (rng() % 4 == 0 ? int(rng() % 3) - 1 : 0);
    };
    const int x = 20 + int(rng() % 8), y = 20 + int(rng() % 8);
    ASSERT_TRUE(matches_oracle(near(x), near(y), near(20 + int(rng() % 8)), near(20 + int(rng() % 8))));
  }
}

// Lines as long as the guard band lets them be, looked at in one tile.
TEST(DiamondExit, LongLines) {
  using Wide = boost::multiprecision::int256_t;
  std::mt19937 rng(9);
  const int span = (kGuardBandMax - kGuardBandMin) * kSubpixelScale;
  for (int n = 0; n < 200; ++n) {
    // Aim through a point of the tile, then take two points of that line, off it by their rounding.
    const int tile = 64 * int(rng() % 200);
    const double cx = (tile + int(rng() % 64)) * 256.0, cy = (tile + int(rng() % 64)) * 256.0;
    const double dx = double(rng() % 2001) - 1000,
                 dy = n % 3 == 0 ? (rng() % 2 ? dx : -dx) : double(rng() % 2001) - 1000;
    const auto end = [&](double t, double c, double d) {
      const double v = c + t * d;
      return int(std::clamp(v, kGuardBandMin * 256.0, kGuardBandMin * 256.0 + span - 1));
    };
    const double t0 = -double(rng() % 4000), t1 = double(rng() % 4000);
    const int x0 = end(t0, cx, dx), y0 = end(t0, cy, dy), x1 = end(t1, cx, dx), y1 = end(t1, cy, dy);
    const Oracle<Wide, 30> oracle(x0, y0, x1, y1);
    const Pixels pixels = covered(x0, y0, x1, y1, tile, tile, kEverywhere);
    for (int i = 0; i < 64 * 64; ++i) {
      const int px = tile + i % 64, py = tile + i / 64;
      ASSERT_EQ(pixels.count({px, py}) != 0, oracle.makes_fragment(px, py))
          << x0 << "," << y0 << " " << x1 << "," << y1;
    }
  }
}

TEST(DiamondExit, ALineCutInTwoMakesTheSameFragmentsOnce) {
  std::mt19937 rng(3);
  for (int n = 0; n < 20000; ++n) {
    const int x0 = 5000 + int(rng() % 2048), y0 = 5000 + int(rng() % 2048);
    const int dx = int(rng() % 2048) - 1024, dy = int(rng() % 2048) - 1024;
    const Pixels whole = covered(x0, y0, x0 + 2 * dx, y0 + 2 * dy, 0, 0, kEverywhere);
    Pixels halves = covered(x0, y0, x0 + dx, y0 + dy, 0, 0, kEverywhere);
    const Pixels second = covered(x0 + dx, y0 + dy, x0 + 2 * dx, y0 + 2 * dy, 0, 0, kEverywhere);
    const size_t sum = halves.size() + second.size();
    halves.insert(second.begin(), second.end());
    ASSERT_EQ(halves.size(), sum) << "a fragment was made twice";
    ASSERT_EQ(halves, whole);
  }
}

TEST(DiamondExit, TilesAndBoundsOnlyCut) {
  const int x0 = 1234, y0 = 60000, x1 = 50001, y1 = 3333;
  const Rect bounds = {17, 30, 170, 200};
  const Oracle<__int128, 14> oracle(x0, y0, x1, y1);
  Pixels all;
  for (int ty = 0; ty < 256; ty += 64) {
    for (int tx = 0; tx < 256; tx += 64) all.merge(covered(x0, y0, x1, y1, tx, ty, bounds));
  }
  for (int i = 0; i < 256 * 256; ++i) {
    const int px = i % 256, py = i / 256;
    const bool inside = px >= bounds.x0 && px < bounds.x1 && py >= bounds.y0 && py < bounds.y1;
    ASSERT_EQ(all.count({px, py}) != 0, inside && oracle.makes_fragment(px, py)) << px << "," << py;
  }
}

TEST(SmallPoint, TakesThePixelThatHoldsIt) {
  for (int x = 63 * 256; x <= 65 * 256; ++x) {
    TileCoverage coverage;
    cover_point(x, 10 * 256 + 255, 1, 64, 0, {0, 0, 1000, 1000}, coverage);
    if (x < 64 * 256) {
      ASSERT_EQ(coverage.touched, 0u) << x;
      continue;
    }
    const int px = x / 256 - 64;
    ASSERT_EQ(coverage.touched, uint64_t{1} << 8) << x;
    ASSERT_EQ(coverage.blocks[8], uint64_t{1} << (2 * 8 + px)) << x;
  }
}

}  // namespace
}  // namespace halfspace::raster
