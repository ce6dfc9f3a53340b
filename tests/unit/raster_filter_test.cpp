// The filter of triangles, on every instruction set, against a look at every pixel.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <random>
#include <sstream>

#include "raster/api/device.h"
#include "raster/primitive/segment.h"
#include "raster/primitive/triangle_filter.h"
#include "tests/unit/raster_front.h"

namespace halfspace::raster::test {
namespace {

constexpr Rect kBounds{3, 2, 13, 14};  // within the 16 x 16 pixels the triangles lie in
// Where those begin: four tiles meet among them.
constexpr int kLeft = 2 * kTileSize - 7, kBottom = kTileSize - 9, kTilesX = 5;

constexpr uint32_t kBase = 4000000000;  // what corners are counted from

struct Corner {
  int32_t x, y;
};
using Triangle = std::array<Corner, 3>;

std::vector<std::string> levels() {
  std::istringstream names{std::string(isa_available())};
  return {std::istream_iterator<std::string>(names), {}};
}

int64_t area_of(const Triangle& t) {
  return (int64_t{t[1].x} - t[0].x) * (t[2].y - t[0].y) - (int64_t{t[2].x} - t[0].x) * (t[1].y - t[0].y);
}

bool covers_a_pixel(const Triangle& t) {
  const int32_t x[3] = {t[0].x, t[1].x, t[2].x}, y[3] = {t[0].y, t[1].y, t[2].y};
  for (int py = kBounds.y0; py < kBounds.y1; ++py)
    for (int px = kBounds.x0; px < kBounds.x1; ++px)
      if (covers(x, y, px, py)) return true;
  return false;
}

// Corners on every 1/256 pixel, on pixel centres and on their edges; of all sizes, many of them tiny.
Triangle random_triangle(std::mt19937& random) {
  const int32_t step = std::array{1, 1, 128, 64}[random() % 4];
  const auto reach = int32_t(16) << random() % 12;
  const auto near = [&](int32_t middle) {
    return (middle + int32_t(random() % uint32_t(2 * reach)) - reach) / step * step;
  };
  const auto middle_x = int32_t(random() % 4096), middle_y = int32_t(random() % 4096);
  Triangle t;
  for (Corner& c : t) c = {near(middle_x), near(middle_y)};
  return t;
}

// Every pixel the triangle covers lies in a tile that is to be looked at.
void expect_tiles(const Triangle& t, const FilteredTriangles& found, uint32_t i) {
  const int32_t x[3] = {t[0].x, t[1].x, t[2].x}, y[3] = {t[0].y, t[1].y, t[2].y};
  const int x0 = found.tile_x0[i], x1 = found.tile_x1[i], y0 = found.tile_y0[i], y1 = found.tile_y1[i];
  for (int py = kBounds.y0; py < kBounds.y1; ++py) {
    for (int px = kBounds.x0; px < kBounds.x1; ++px) {
      if (!covers(x, y, px, py)) continue;
      const int tx = (px + kLeft) / kTileSize, ty = (py + kBottom) / kTileSize;
      ASSERT_TRUE(tx >= x0 && tx <= x1 && ty >= y0 && ty <= y1);
    }
  }
  ASSERT_EQ(found.in_one_tile >> i & 1, x0 == x1 && y0 == y1 ? 1u : 0u);
  ASSERT_EQ(found.tile[i], y0 * kTilesX + x0);
}

class Filter {
 public:
  Filter(bool cull_clockwise, bool cull_counter_clockwise)
      : filter_{reinterpret_cast<const std::byte*>(corners_.data()),
                sizeof(Corner),
                kBase,
                outcodes_.data(),
                {kLeft + kBounds.x0, kBottom + kBounds.y0, kLeft + kBounds.x1, kBottom + kBounds.y1},
                cull_clockwise,
                cull_counter_clockwise,
                kTilesX} {}

  using Outcodes = std::array<std::array<uint16_t, 3>, kFilterLanes>;
  FilteredTriangles run(const std::array<Triangle, kFilterLanes>& triangles, uint32_t count,
                        const Outcodes& outcodes = {}) {
    std::array<uint32_t, 3 * kFilterLanes> order;
    for (uint32_t i = 0; i < order.size(); ++i) {
      order[i] = uint32_t(order.size()) - 1 - i;
      const Corner& c = triangles[i / 3][i % 3];
      corners_[order[i]] = {c.x + kLeft * kSubpixelScale, c.y + kBottom * kSubpixelScale};
      outcodes_[order[i]] = outcodes[i / 3][i % 3];
      if ((outcodes_[order[i]] & (kOutCutMask | kOutNotFinite)) != 0) corners_[order[i]] = {kNoPlace, kNoPlace};
    }
    FilteredTriangles found{};
    for (uint32_t& corner : order) corner += kBase;
    triangle_filter()(filter_, order.data(), count, found);
    return found;
  }

 private:
  std::array<Corner, 3 * kFilterLanes> corners_;
  std::array<uint16_t, 3 * kFilterLanes> outcodes_{};
  TriangleFilter filter_;
};

TEST(TriangleFilter, KeepsWhatCoversAPixel) {
  const std::string before(isa_name());
  for (const std::string& level : levels()) {
    ASSERT_TRUE(set_isa(level));
    std::mt19937 random(7);
    for (int round = 0; round < 20000; ++round) {
      const bool cull_clockwise = random() % 4 == 0, cull_counter_clockwise = random() % 4 == 0;
      const uint32_t count = 1 + random() % kFilterLanes;
      std::array<Triangle, kFilterLanes> triangles;
      for (Triangle& t : triangles) t = random_triangle(random);
      const FilteredTriangles found = Filter(cull_clockwise, cull_counter_clockwise).run(triangles, count);
      ASSERT_EQ(found.kept >> count, 0u);
      ASSERT_EQ(found.dropped, count - uint32_t(std::popcount(found.kept)));
      for (uint32_t i = 0; i < count; ++i) {
        const Triangle& t = triangles[i];
        const int64_t area = area_of(t);
        const bool culled = area == 0 || (area > 0 ? cull_counter_clockwise : cull_clockwise);
        const bool kept = found.kept >> i & 1;
        int32_t low_x = t[0].x, high_x = low_x, low_y = t[0].y, high_y = low_y;
        for (const Corner& c : t) {
          low_x = std::min(low_x, c.x), high_x = std::max(high_x, c.x);
          low_y = std::min(low_y, c.y), high_y = std::max(high_y, c.y);
        }
        if (!culled && covers_a_pixel(t)) {
          ASSERT_TRUE(kept) << level;
          ASSERT_EQ(found.clockwise >> i & 1, area < 0 ? 1u : 0u);
          for (int k = 0; k < 3; ++k) ASSERT_EQ(found.x[k][i], t[size_t(k)].x + kLeft * kSubpixelScale);
          for (int k = 0; k < 3; ++k) ASSERT_EQ(found.y[k][i], t[size_t(k)].y + kBottom * kSubpixelScale);
          expect_tiles(t, found, i);
        } else if (culled || std::max(high_x - low_x, high_y - low_y) < 3 * kSubpixelScale) {
          ASSERT_FALSE(kept) << level;
        }
      }
    }
  }
  set_isa(before);
}

// A corner of a few has no place: those are left to be cut, or dropped, and the others not touched.
TEST(TriangleFilter, LeavesWhatHasNoPlace) {
  const std::string before(isa_name());
  for (const std::string& level : levels()) {
    ASSERT_TRUE(set_isa(level));
    std::mt19937 random(9);
    for (int round = 0; round < 5000; ++round) {
      const uint32_t count = 1 + random() % kFilterLanes;
      std::array<Triangle, kFilterLanes> triangles;
      for (Triangle& t : triangles) t = random_triangle(random);
      Filter::Outcodes outcodes{};
      for (auto& of_triangle : outcodes)
        for (uint16_t& code : of_triangle)
          code = std::array<uint16_t, 8>{0, 0, 0, 0, kOutNear, kOutNear | kOutW, kOutGuardLeft | kOutLeft,
                                         kOutNotFinite}[random() % (round % 2 == 0 ? 8 : 5)];
      const FilteredTriangles found = Filter(false, false).run(triangles, count, outcodes);
      const FilteredTriangles placed = Filter(false, false).run(triangles, count);
      for (uint32_t i = 0; i < kFilterLanes; ++i) {
        const auto& o = outcodes[i];
        const unsigned any = unsigned{o[0]} | o[1] | o[2];
        const bool out = (o[0] & o[1] & o[2]) != 0 || (any & kOutNotFinite) != 0;
        const bool special = i < count && any != 0 && !out;
        ASSERT_EQ(found.special >> i & 1, special ? 1u : 0u) << level;
        ASSERT_EQ(found.kept >> i & 1, any == 0 ? placed.kept >> i & 1 : 0u) << level;
      }
      ASSERT_EQ(found.dropped, count - uint32_t(std::popcount(found.kept | found.special)));
    }
  }
  set_isa(before);
}

}  // namespace
}  // namespace halfspace::raster::test
