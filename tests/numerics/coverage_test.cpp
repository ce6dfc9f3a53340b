// Every pixel of every kind of triangle against the exact oracle, on every instruction set.
#include "tests/oracle/coverage.h"

#include <gtest/gtest.h>

#include <functional>
#include <sstream>

#include "tests/support/canvas.h"
#include "tests/support/random.h"

namespace halfspace::test {
namespace {

using namespace raster;
using oracle::SnappedPoint;
using oracle::SnappedTriangle;

constexpr int kViewport = 128;              // pixels a side; a power of two, so that clip_of is exact
constexpr int kWidth = 80, kHeight = 72;    // four tiles, none of them whole
constexpr int kPixel = 256, kCenter = 128;  // 1/256 px

// Every fragment adds one level.
DrawState counting_state() {
  DrawState state = plain_state(kViewport, kViewport);
  state.blend = {true, BlendFactor::one, BlendFactor::one};
  return state;
}
constexpr Color kOne{1.0f / 255, 1.0f / 255, 1.0f / 255, 1.0f / 255};

Picture count_fragments(std::span<const SnappedTriangle> triangles) {
  std::vector<Vertex> vertices;
  for (const SnappedTriangle& t : triangles) {
    for (const SnappedPoint& p : t) vertices.push_back(snapped_vertex(p.x, p.y, kViewport));
  }
  Canvas canvas(kWidth, kHeight);
  canvas.draw_plain(counting_state(), Primitive::triangles, vertices, kOne);
  return canvas.read();
}

std::vector<int> count_by_oracle(std::span<const SnappedTriangle> triangles) {
  std::vector<int> counts(size_t{kWidth} * kHeight);
  for (const SnappedTriangle& t : triangles) {
    const std::vector<uint8_t> covered = oracle::coverage(t, kWidth, kHeight);
    for (size_t i = 0; i < counts.size(); ++i) counts[i] += covered[i];
  }
  return counts;
}

std::string describe(const SnappedTriangle& t) {
  std::ostringstream text;
  for (const SnappedPoint& p : t) text << "(" << p.x << ", " << p.y << ") ";
  return text.str() + "/ 256 px";
}

// Index of the first pixel whose count is wrong, or -1.
int first_wrong(const Picture& picture, const std::vector<int>& counts) {
  for (size_t i = 0; i < counts.size(); ++i) {
    if (picture.rgba[4 * i] != counts[i]) return int(i);
  }
  return -1;
}

// Draws all at once; when the counts are wrong, looks for a triangle that is wrong alone.
void expect_exact(const std::vector<SnappedTriangle>& triangles) {
  ASSERT_LE(triangles.size(), 255u);
  const std::vector<int> expected = count_by_oracle(triangles);
  for (const std::string& isa : isa_levels()) {
    const IsaScope scope(isa);
    const int wrong = first_wrong(count_fragments(triangles), expected);
    if (wrong < 0) continue;
    for (const SnappedTriangle& t : triangles) {
      const Picture alone = count_fragments({&t, 1});
      const int i = first_wrong(alone, count_by_oracle({&t, 1}));
      ASSERT_LT(i, 0) << isa << ": " << describe(t) << " has " << int(alone.rgba[4 * size_t(i)])
                      << " fragments at (" << i % kWidth << ", " << i / kWidth << ")";
    }
    FAIL() << isa << ": wrong together only, at (" << wrong % kWidth << ", " << wrong / kWidth << ")";
  }
}

void expect_exact_for(uint64_t seed, const std::function<SnappedTriangle(Random&)>& make) {
  Random random(seed);
  const int batches = long_tests() ? 40 : 2;
  for (int b = 0; b < batches && !testing::Test::HasFatalFailure(); ++b) {
    std::vector<SnappedTriangle> triangles;
    for (int i = 0; i < 100; ++i) triangles.push_back(make(random));
    expect_exact(triangles);
  }
}

// A point around the framebuffer, on the grid {offset + k * step}.
SnappedPoint point_on(Random& random, int64_t step, int64_t offset) {
  const auto coordinate = [&](int size) {
    return offset + step * random.integer(-16 * kPixel / step, (size + 16) * kPixel / step);
  };
  const int64_t x = coordinate(kWidth);
  return {x, coordinate(kHeight)};
}

SnappedTriangle triangle_on(Random& random, int64_t step, int64_t offset) {
  const SnappedPoint a = point_on(random, step, offset), b = point_on(random, step, offset);
  return {a, b, point_on(random, step, offset)};
}

TEST(Coverage, RandomCorners) {
  expect_exact_for(1, [](Random& r) { return triangle_on(r, 1, 0); });
}
TEST(Coverage, CornersOnSixteenths) {
  expect_exact_for(2, [](Random& r) { return triangle_on(r, 16, 0); });
}
TEST(Coverage, CornersOnPixelCentres) {
  expect_exact_for(3, [](Random& r) { return triangle_on(r, kPixel, kCenter); });
}
TEST(Coverage, CornersOnPixelCorners) {
  expect_exact_for(4, [](Random& r) { return triangle_on(r, kPixel, 0); });
}

TEST(Coverage, SmallTriangles) {
  expect_exact_for(5, [](Random& r) {
    SnappedTriangle t;
    t[0] = point_on(r, 1, 0);
    for (size_t i = 1; i < 3; ++i) t[i] = {t[0].x + r.integer(-600, 600), t[0].y + r.integer(-600, 600)};
    return t;
  });
}

// On a grid of half pixels most edges pass through centres.
TEST(Coverage, SmallTrianglesThroughCentres) {
  expect_exact_for(6, [](Random& r) {
    SnappedTriangle t;
    t[0] = point_on(r, kCenter, 0);
    for (size_t i = 1; i < 3; ++i) {
      t[i] = {t[0].x + kCenter * r.integer(-6, 6), t[0].y + kCenter * r.integer(-6, 6)};
    }
    return t;
  });
}

// Edges that run along the borders of tiles and blocks, through the centres there.
TEST(Coverage, EdgesAlongTilesAndBlocks) {
  expect_exact_for(7, [](Random& r) {
    const auto border = [&r] { return 8 * kPixel * r.integer(-1, 10) + kCenter * r.integer(-1, 1); };
    const SnappedPoint a{border(), border()}, b{r.integer(0, 1) ? a.x : border(), border()};
    return SnappedTriangle{a, b, {border(), r.integer(0, 1) ? a.y : border()}};
  });
}

// Slanted edges through the centre of a tile's corner pixel: it may be all the tile has of the triangle, and nothing but
// the rule for edges says whose it is.
TEST(Coverage, EdgesThroughTheCornersOfTiles) {
  constexpr int64_t kTile = 64 * kPixel;
  expect_exact_for(14, [](Random& r) {
    const auto corner = [&r] { return kTile + (r.integer(0, 1) ? kCenter : -kCenter); };
    const SnappedPoint centre{corner(), corner()};
    const int64_t dx = r.integer(1, 30) * kPixel, dy = r.integer(1, 30) * kPixel * (r.integer(0, 1) ? 1 : -1);
    const SnappedPoint a{centre.x - dx, centre.y - dy}, b{centre.x + dx, centre.y + dy};
    return SnappedTriangle{a, b, r.integer(0, 1) ? SnappedPoint{a.x, b.y} : SnappedPoint{b.x, a.y}};
  });
}

// One corner 10^3 .. 10^4 px away, all inside the guard band.
TEST(Coverage, FarCorner) {
  expect_exact_for(8, [](Random& r) {
    SnappedTriangle t = triangle_on(r, 1, 0);
    const auto far = [&r] { return kPixel * r.integer(-8000, 16000) + r.integer(0, 255); };
    t[0] = {far(), far()};
    if (r.integer(0, 3) == 0) t[1] = {far(), far()};
    return t;
  });
}

TEST(Coverage, Slivers) {
  expect_exact_for(9, [](Random& r) {
    const SnappedPoint a = point_on(r, 1, 0), b = point_on(r, 1, 0);
    return SnappedTriangle{a, b, {b.x + r.integer(-1, 1), b.y + r.integer(-1, 1)}};
  });
}

// A needle across the picture, 1/256 px wide, whose ends are thousands of pixels apart.
TEST(Coverage, LongSlivers) {
  expect_exact_for(10, [](Random& r) {
    const SnappedPoint middle = point_on(r, kCenter, 0);
    const int64_t dx = r.integer(-8000, 8000) * 64, dy = r.integer(-8000, 8000) * 64;
    const SnappedPoint a{middle.x - dx, middle.y - dy}, b{middle.x + dx, middle.y + dy};
    return SnappedTriangle{a, b, {b.x + r.integer(-1, 1), b.y + r.integer(-1, 1)}};
  });
}

TEST(Coverage, HorizontalVerticalAndDiagonalEdges) {
  expect_exact_for(11, [](Random& r) {
    const SnappedPoint a = point_on(r, kCenter, 0);
    const int64_t n = kCenter * r.integer(-40, 40), m = kCenter * r.integer(-40, 40);
    switch (r.integer(0, 2)) {
      case 0:
        return SnappedTriangle{a, {a.x + n, a.y}, {a.x, a.y + m}};
      case 1:
        return SnappedTriangle{a, {a.x + n, a.y + n}, {a.x + m, a.y}};
      default:
        return SnappedTriangle{a, {a.x + n, a.y - n}, {a.x, a.y + m}};
    }
  });
}

// Beyond the guard band a triangle is cut, and a cut corner is snapped: the edge may move by that much.
TEST(Coverage, CornersBeyondTheGuardBand) {
  Random random(12);
  for (int i = 0; i < (long_tests() ? 2000 : 60); ++i) {
    SnappedTriangle t = triangle_on(random, 1, 0);
    // 2^15 .. 2^22 px; multiples that a float's 24 bits hold.
    const int64_t step = int64_t{kPixel} << random.integer(0, 7);
    const auto far = [&] { return step * random.integer(32768, 65535) * (random.integer(0, 1) ? 1 : -1); };
    t[0] = {far() + kPixel * kViewport / 2, far() + kPixel * kViewport / 2};
    const Picture picture = count_fragments({&t, 1});
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (picture.pixel(x, y)[0] == int(oracle::covers(t, x, y))) continue;
        ASSERT_LT(oracle::distance_to_edge(t, x, y), 1.0 / 128) << describe(t) << " at " << x << ", " << y;
      }
    }
  }
}

// The three orders of the corners and both windings cover the same pixels.
TEST(Coverage, OrderOfCornersDoesNotMatter) {
  Random random(13);
  for (int i = 0; i < 30; ++i) {
    const SnappedTriangle t = triangle_on(random, kCenter, 0);
    const Picture picture = count_fragments({&t, 1});
    SnappedTriangle turned = t;
    std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    EXPECT_EQ(first_difference(picture, count_fragments({&turned, 1})), "") << describe(t);
    std::swap(turned[0], turned[1]);
    EXPECT_EQ(first_difference(picture, count_fragments({&turned, 1})), "") << describe(t);
  }
}

// Corners that fall between the grid's points are taken to floor(v * 256 + 1/2), below zero too; every other
// triangle's fall exactly halfway.
TEST(Coverage, CornersAreSnappedToTheNearestGridPoint) {
  Random random(14);
  for (int i = 0; i < 60; ++i) {
    std::vector<Vertex> vertices(3);
    SnappedTriangle t;
    for (size_t k = 0; k < 3; ++k) {
      // -1.3 .. 1, in steps of half a grid point when they are to be halfway: then on pixel centres after
      // snapping.
      const auto coordinate = [&] {
        if (i % 2 == 0) return random.real(-1.3f, 1.0f);
        const int64_t centre = kPixel * random.integer(-16, 80) + kCenter;
        return float(2 * centre - 1 - kPixel * kViewport) / float(kPixel * kViewport);
      };
      vertices[k].x = coordinate();
      vertices[k].y = coordinate();
      t[k].x = oracle::snap((static_cast<long double>(vertices[k].x) + 1) * kViewport / 2);
      t[k].y = oracle::snap((static_cast<long double>(vertices[k].y) + 1) * kViewport / 2);
      ASSERT_TRUE(i % 2 == 0 || (t[k].x - kCenter) % kPixel == 0);
    }
    Canvas canvas(kWidth, kHeight);
    canvas.draw_plain(counting_state(), Primitive::triangles, vertices, kOne);
    EXPECT_EQ(first_wrong(canvas.read(), count_by_oracle({&t, 1})), -1) << describe(t);
  }
}

}  // namespace
}  // namespace halfspace::test
