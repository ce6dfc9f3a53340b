#include "compare/difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace halfspace::compare {
namespace {

EdgeMask no_edges(const Image& image) {
  return {image.width, image.height, std::vector<uint8_t>(image.pixels.size())};
}

TEST(Difference, EqualPicturesAreEqual) {
  const Image a(5, 3, {1, 2, 3, 255});
  const Difference d = compare_images(a, a, no_edges(a));
  EXPECT_EQ(d.pixels, 15u);
  EXPECT_EQ(d.differing, 0u);
  EXPECT_EQ(d.max, 0);
  EXPECT_TRUE(std::isinf(d.psnr()));
  EXPECT_FALSE(d.worst);
  EXPECT_TRUE(broken_limits(d, {}).empty());
}

using Limit = std::optional<double>;

Limits limits(Limit differing_percent, Limit difference_levels, Limit interior_levels) {
  return {differing_percent, difference_levels, interior_levels};
}

// 10 x 10 pixels, four of them off: by 1, 2, 3 and 9 levels in different channels and directions.
struct KnownDifference : testing::Test {
  KnownDifference() : a(10, 10, {100, 100, 100, 255}), b(a) {
    b.at(1, 0) = {101, 100, 100, 255};
    b.at(2, 0) = {100, 98, 100, 255};
    b.at(3, 5) = {100, 100, 103, 255};
    b.at(9, 9) = {109, 92, 101, 255};
  }
  Image a, b;
};

TEST_F(KnownDifference, IsCounted) {
  const Difference d = compare_images(a, b, no_edges(a));
  EXPECT_EQ(d.differing, 4u);
  EXPECT_DOUBLE_EQ(d.differing_percent(), 4.0);
  EXPECT_EQ(d.above_1, 3u);
  EXPECT_EQ(d.above_2, 2u);
  EXPECT_EQ(d.above_8, 1u);
  EXPECT_EQ(d.max, 9);
}

TEST_F(KnownDifference, HasChannels) {
  const Difference d = compare_images(a, b, no_edges(a));
  EXPECT_EQ(d.channel_count(), 3);
  EXPECT_EQ(d.channels[0].max, 9);
  EXPECT_EQ(d.channels[1].max, 8);
  EXPECT_EQ(d.channels[2].max, 3);
  EXPECT_DOUBLE_EQ(d.channels[0].mean, 0.10);
  EXPECT_DOUBLE_EQ(d.channels[1].mean, 0.10);
  EXPECT_DOUBLE_EQ(d.channels[2].mean, 0.04);
  EXPECT_DOUBLE_EQ(d.mean, 0.08);
  EXPECT_DOUBLE_EQ(d.mean_squared, (1 + 4 + 9 + 81 + 64 + 1) / 300.0);
  EXPECT_NEAR(d.psnr(), 10 * std::log10(65025 * 300.0 / 160), 1e-9);
}

TEST_F(KnownDifference, NamesTheWorst) {
  const Difference d = compare_images(a, b, no_edges(a));
  ASSERT_TRUE(d.worst);
  EXPECT_EQ(d.worst->x, 9);
  EXPECT_EQ(d.worst->y, 9);
  EXPECT_EQ(d.worst->a[0], 100);
  EXPECT_EQ(d.worst->b[0], 109);
}

TEST_F(KnownDifference, IsSplitByTheMask) {
  Image mask(10, 10, {0, 0, 0, 255});
  mask.at(9, 9) = {255, 255, 255, 255};
  mask.at(0, 0) = {0, 0, 1, 255};
  const Difference d = compare_images(a, b, edges_from_mask(mask));
  EXPECT_EQ(d.edge_pixels, 2u);
  EXPECT_EQ(d.differing_edge, 1u);
  EXPECT_EQ(d.differing_interior, 3u);
  EXPECT_EQ(d.max, 9);
  EXPECT_EQ(d.max_interior, 3);
  EXPECT_EQ(d.above_1_interior, 2u);
  ASSERT_TRUE(d.worst_interior);
  EXPECT_EQ(d.worst_interior->x, 3);
  EXPECT_EQ(d.worst_interior->y, 5);
}

TEST_F(KnownDifference, LimitsAreTheStatedOnes) {
  const Difference d = compare_images(a, b, no_edges(a));
  EXPECT_EQ(broken_limits(d, {}).size(), 1u);
  EXPECT_TRUE(broken_limits(d, limits(4.0, {}, {})).empty());
  EXPECT_EQ(broken_limits(d, limits(3.9, {}, {})).size(), 1u);
  EXPECT_TRUE(broken_limits(d, limits({}, 9.0, {})).empty());
  EXPECT_EQ(broken_limits(d, limits({}, 8.0, {})).size(), 1u);
  EXPECT_EQ(broken_limits(d, limits(1.0, 8.0, 2.0)).size(), 3u);
}

TEST_F(KnownDifference, IsAmplifiedWithoutSign) {
  const Image image = amplified_difference(a, b, 16);
  EXPECT_EQ(image.at(0, 0), (Pixel{0, 0, 0, 255}));
  EXPECT_EQ(image.at(1, 0), (Pixel{16, 0, 0, 255}));
  EXPECT_EQ(image.at(2, 0), (Pixel{0, 32, 0, 255}));
  EXPECT_EQ(image.at(9, 9), (Pixel{144, 128, 16, 255}));
  EXPECT_EQ(amplified_difference(a, b, 1000).at(9, 9), (Pixel{255, 255, 255, 255}));
}

// Columns 0..3 dark, 4..7 bright: the columns on both sides of the jump are edges.
TEST(Edges, AreWhereTheFirstPictureJumps) {
  Image a(8, 4, {10, 10, 10, 255});
  for (int y = 0; y < 4; ++y)
    for (int x = 4; x < 8; ++x) a.at(x, y) = {10, 10, 43, 255};
  const EdgeMask edges = find_edges(a, 32);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) EXPECT_EQ(edges.is_edge[a.index(x, y)], x == 3 || x == 4) << x << "," << y;
  for (uint8_t edge : find_edges(a, 33).is_edge) EXPECT_EQ(edge, 0);
}

TEST(Edges, OfCoverageAreWhereAnotherPrimitiveIsShown) {
  Image a(3, 3, {1, 0, 0, 255}), b = a;
  EXPECT_EQ(edges_of_coverage(a, b).is_edge, std::vector<uint8_t>(9));
  b.at(2, 1) = {0, 0, 1, 255};
  const EdgeMask edges = edges_of_coverage(a, b);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) EXPECT_EQ(edges.is_edge[a.index(x, y)], x == 2 && y == 1);
  EXPECT_THROW(edges_of_coverage(a, Image(3, 2, {})), ImageError);
}

TEST(Edges, AreFoundAcrossACorner) {
  Image a(3, 3, {0, 0, 0, 255});
  a.at(2, 2) = {255, 0, 0, 255};
  const EdgeMask edges = find_edges(a);
  EXPECT_EQ(edges.is_edge[a.index(1, 1)], 1);
  EXPECT_EQ(edges.is_edge[a.index(0, 0)], 0);
  EXPECT_EQ(edges.is_edge[a.index(0, 2)], 0);
}

// What NUMERICS calls an interior pixel must not be excused by the difference itself.
TEST(Edges, AStrayPixelInTheSecondPictureIsInside) {
  const Image a(9, 9, {0, 0, 0, 255});
  Image b = a;
  b.at(4, 4) = {255, 255, 255, 255};
  const Difference d = compare_images(a, b, find_edges(a));
  EXPECT_EQ(d.differing_interior, 1u);
  EXPECT_EQ(d.max_interior, 255);
}

TEST(Difference, AlphaCountsWhenEitherPictureHasIt) {
  const Image a(2, 1, {7, 7, 7, 255});
  Image b = a;
  b.has_alpha = true;
  b.at(1, 0)[3] = 250;
  const Difference d = compare_images(a, b, no_edges(a));
  EXPECT_EQ(d.channel_count(), 4);
  EXPECT_EQ(d.differing, 1u);
  EXPECT_EQ(d.channels[3].max, 5);
  b.has_alpha = false;
  EXPECT_EQ(compare_images(a, b, no_edges(a)).differing, 0u);
}

TEST(Difference, SeesFractionsOfALevelAndNotANumber) {
  Image a(3, 1, {50, 50, 50, 255});
  Image b = a;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  b.at(0, 0)[1] = 50.25f;
  b.at(1, 0)[2] = nan;
  a.at(2, 0)[0] = b.at(2, 0)[0] = nan;
  const Difference d = compare_images(a, b, no_edges(a));
  EXPECT_EQ(d.differing, 2u);
  EXPECT_DOUBLE_EQ(d.channels[1].max, 0.25);
  EXPECT_EQ(d.max, 255);
}

TEST(Difference, RefusesOtherSizes) {
  const Image a(4, 4), b(4, 5);
  EXPECT_THROW(compare_images(a, b, no_edges(a)), ImageError);
  EXPECT_THROW(compare_images(a, a, no_edges(b)), ImageError);
  EXPECT_THROW(amplified_difference(a, b, 2), ImageError);
}

}  // namespace
}  // namespace halfspace::compare
