// Which primitives the ten modes make, what is dropped, and which tiles hear of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "tests/unit/raster_front.h"

namespace halfspace::raster {
namespace {

using test::Front;
using ::testing::ElementsAre;
using Corners = std::vector<uint32_t>;

// Vertices on a convex curve: any three make a triangle of some area, counter-clockwise when ascending.
Front convex(uint32_t count) {
  Front f;
  for (uint32_t i = 0; i < count; ++i) {
    const float t = float(i) / float(count) * 2 - 1;
    f.add(t * 0.9f, t * t * 0.9f);
  }
  return f;
}

std::vector<Corners> assembled(Front& f, Primitive mode) {
  f.run(mode);
  std::vector<Corners> all;
  for (const PrimitiveRef& ref : f.segment.primitives) {
    Corners c;
    const int corners = ref.kind == PrimitiveKind::triangle ? 3 : ref.kind == PrimitiveKind::line ? 2 : 1;
    for (int i = 0; i < corners; ++i) c.push_back(ref.v[i]);
    c.push_back(ref.v[ref.provoking]);  // last: the vertex that gives the flat colour
    all.push_back(c);
  }
  return all;
}

std::vector<Corners> assembled(uint32_t count, Primitive mode) {
  Front f = convex(count);
  return assembled(f, mode);
}

TEST(Assembly, Lists) {
  EXPECT_THAT(assembled(3, Primitive::points), ElementsAre(Corners{0, 0}, Corners{1, 1}, Corners{2, 2}));
  EXPECT_THAT(assembled(5, Primitive::lines), ElementsAre(Corners{0, 1, 1}, Corners{2, 3, 3}));
  EXPECT_THAT(assembled(8, Primitive::triangles), ElementsAre(Corners{0, 1, 2, 2}, Corners{3, 4, 5, 5}));
}

TEST(Assembly, StripsAndLoopsOfLines) {
  EXPECT_THAT(assembled(3, Primitive::line_strip), ElementsAre(Corners{0, 1, 1}, Corners{1, 2, 2}));
  EXPECT_THAT(assembled(3, Primitive::line_loop),
              ElementsAre(Corners{0, 1, 1}, Corners{1, 2, 2}, Corners{2, 0, 0}));
  EXPECT_THAT(assembled(2, Primitive::line_loop), ElementsAre(Corners{0, 1, 1}, Corners{1, 0, 0}));
  EXPECT_THAT(assembled(1, Primitive::line_loop), ElementsAre());
}

TEST(Assembly, StripsFansAndPolygonsOfTriangles) {
  EXPECT_THAT(assembled(5, Primitive::triangle_strip),
              ElementsAre(Corners{0, 1, 2, 2}, Corners{2, 1, 3, 3}, Corners{2, 3, 4, 4}));
  EXPECT_THAT(assembled(4, Primitive::triangle_fan), ElementsAre(Corners{0, 1, 2, 2}, Corners{0, 2, 3, 3}));
  EXPECT_THAT(assembled(4, Primitive::polygon), ElementsAre(Corners{0, 1, 2, 0}, Corners{0, 2, 3, 0}));
  EXPECT_THAT(assembled(2, Primitive::polygon), ElementsAre());
}

// Every quad as two triangles that share a diagonal, cover it, turn the same way and have the same flat
// colour.
TEST(Assembly, QuadsAreSplitConsistently) {
  EXPECT_THAT(assembled(7, Primitive::quads), ElementsAre(Corners{0, 1, 3, 3}, Corners{1, 2, 3, 3}));
  Front f;
  const float xs[] = {-0.8f, -0.3f, 0.2f};
  for (float x : xs) f.add(x, 0.5f), f.add(x, -0.5f);
  f.add(0.7f, 0.5f);  // one too many: an incomplete quad
  const std::vector<Corners> strip = assembled(f, Primitive::quad_strip);
  ASSERT_EQ(strip.size(), 4u);
  for (const PrimitiveRef& ref : f.segment.primitives) EXPECT_FALSE(ref.back_facing);
  for (uint32_t q = 0; q < 2; ++q) {
    std::set<uint32_t> all(strip[2 * q].begin(), strip[2 * q].end());
    all.insert(strip[2 * q + 1].begin(), strip[2 * q + 1].end());
    EXPECT_THAT(all, ElementsAre(2 * q, 2 * q + 1, 2 * q + 2, 2 * q + 3));
    EXPECT_EQ(strip[2 * q][3], 2 * q + 3);
    EXPECT_EQ(strip[2 * q + 1][3], 2 * q + 3);
  }
}

TEST(Assembly, StripsKeepTheirFacing) {
  Front f;
  for (int i = 0; i < 9; ++i) f.add(float(i) * 0.2f - 0.9f, i % 2 ? -0.5f : 0.5f);  // counter-clockwise
  f.run(Primitive::triangle_strip);
  ASSERT_EQ(f.segment.primitives.size(), 7u);
  for (const PrimitiveRef& ref : f.segment.primitives) EXPECT_FALSE(ref.back_facing);
  f.state->raster.front_is_ccw = false;
  f.run(Primitive::triangle_strip);
  for (const PrimitiveRef& ref : f.segment.primitives) EXPECT_TRUE(ref.back_facing);
  f.state->raster.cull_back = true;
  f.run(Primitive::triangle_strip);
  EXPECT_EQ(f.segment.primitives.size(), 0u);
  EXPECT_EQ(f.segment.culled, 7u);
}

TEST(Assembly, AnyRangesGiveTheWhole) {
  const Primitive modes[] = {Primitive::points,       Primitive::lines,     Primitive::line_loop,
                             Primitive::line_strip,   Primitive::triangles, Primitive::triangle_strip,
                             Primitive::triangle_fan, Primitive::quads,     Primitive::quad_strip,
                             Primitive::polygon};
  for (Primitive mode : modes) {
    Front f = convex(24);
    for (uint32_t i = 0; i < 24; ++i) f.indices.push_back((i * 7 + 3) % 24);
    const std::vector<Corners> whole = assembled(f, mode);
    const std::vector<std::vector<uint32_t>> bins = f.segment.bins;
    f.segment.reset(f.segment.tiles_x, f.segment.tiles_y);
    const uint32_t total = primitive_count(mode, 24);
    for (uint32_t first = 0; first < total; first += 5) {
      assemble(f.record, mode, f.indices.data(), 24, first, std::min(5u, total - first), f.segment);
    }
    EXPECT_EQ(f.segment.primitives.size(), whole.size());
    EXPECT_EQ(f.segment.bins, bins);
    EXPECT_EQ(f.segment.draws.size(), 1u);
  }
}

TEST(Assembly, DropsWhatCannotBeSeen) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  Front f;
  f.add(0, 0), f.add(0.5f, 0.5f), f.add(-0.25f, -0.25f);                // no area
  f.add(1.5f, 0), f.add(2, 0), f.add(1.5f, 1);                          // right of the frustum
  f.add(0, 0), f.add(0.5f, nan), f.add(0, 0.5f);                        // not finite
  f.add(0, 0), f.add(0.5f, 0), f.add(0, 0.5f, inf);                     // nor this
  f.add(0, 0, 0, -1), f.add(0.5f, 0, 0, -1), f.add(0, 0.5f, 0, -1);     // behind the eye
  f.add(0.001f, 0.001f), f.add(0.003f, 0.001f), f.add(0.001f, 0.003f);  // between pixel centres
  f.run(Primitive::triangles);
  EXPECT_EQ(f.segment.primitives.size(), 0u);
  EXPECT_EQ(f.segment.culled, 6u);
  EXPECT_EQ(f.segment.touched.size(), 0u);
  f.run(Primitive::points);
  for (const PrimitiveRef& ref : f.segment.primitives) EXPECT_EQ(f.record.vertices.outcodes[ref.v[0]], 0);
}

// Every tile with a covered pixel has the triangle in its bin, and no tile outside the box has; a sliver
// across the picture stays out of most of its box.
TEST(Binning, TilesOfTheTriangleAndFewOthers) {
  std::mt19937 rng(21);
  for (int n = 0; n < 300; ++n) {
    Front f(1024, 512);
    f.record.bounds = {int(rng() % 100), int(rng() % 100), 900 + int(rng() % 124), 400 + int(rng() % 112)};
    for (int i = 0; i < 3; ++i) f.add_window(int(rng() % 262144) / 256.0, int(rng() % 131072) / 256.0);
    f.run(Primitive::triangles);
    if (f.segment.primitives.empty()) continue;
    int32_t x[3], y[3];
    f.corners(f.segment.primitives[0], x, y);
    for (int tile = 0; tile < f.segment.tiles_x * f.segment.tiles_y; ++tile) {
      const Rect t = {tile % f.segment.tiles_x * 64, tile / f.segment.tiles_x * 64,
                      tile % f.segment.tiles_x * 64 + 64, tile / f.segment.tiles_x * 64 + 64};
      bool covered = false;
      const Rect r = intersect(t, f.record.bounds);
      for (int py = r.y0; py < r.y1 && !covered; ++py) {
        for (int px = r.x0; px < r.x1 && !covered; ++px) covered = test::covers(x, y, px, py);
      }
      if (!covered) continue;
      ASSERT_EQ(f.segment.bins[size_t(tile)].size(), 1u) << n;
    }
  }
  Front f(1024, 1024);
  f.add_window(1, 1), f.add_window(1022, 1020), f.add_window(1020, 1022);
  f.run(Primitive::triangles);
  EXPECT_GE(f.segment.touched.size(), 16u);
  EXPECT_LE(f.segment.touched.size(), 48u) << "of 256";
}

}  // namespace
}  // namespace halfspace::raster
