// The range of indices, on every instruction set and at every length about a vector's, and of a draw's
// stretches.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "raster/api/device.h"
#include "raster/primitive/index_part.h"

namespace halfspace::raster::test {
namespace {

std::vector<std::string> levels() {
  std::istringstream names{std::string(isa_available())};
  return {std::istream_iterator<std::string>(names), {}};
}

class IndexPart : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { ASSERT_TRUE(set_isa(GetParam())); }
  void TearDown() override { set_isa(before_); }
  const std::string before_{isa_name()};
};

std::vector<uint32_t> some_indices(size_t count, std::mt19937& random) {
  std::vector<uint32_t> indices(count);
  // Beyond 2^31, too: they are unsigned.
  for (uint32_t& index : indices) index = uint32_t(random()) | 1;
  return indices;
}

TEST_P(IndexPart, RangeIsThatOfEveryPlace) {
  std::mt19937 random(1);
  for (uint32_t count = 1; count < 70; ++count) {
    for (uint32_t place = 0; place < count; ++place) {
      std::vector<uint32_t> indices = some_indices(count, random);
      indices[place] = place % 2 != 0 ? 0 : ~0u;
      const IndexRange range = index_range(indices.data(), count);
      EXPECT_EQ(range.lowest, *std::min_element(indices.begin(), indices.end())) << count << " " << place;
      EXPECT_EQ(range.highest, *std::max_element(indices.begin(), indices.end())) << count << " " << place;
    }
  }
}

TEST_P(IndexPart, RangesAreThoseOfTheStretches) {
  std::mt19937 random(2);
  for (size_t count : {size_t{1}, size_t{kIndexStretch - 1}, size_t{kIndexStretch}, size_t{kIndexStretch + 1},
                       size_t{3 * kIndexStretch + 100}}) {
    const std::vector<uint32_t> indices = some_indices(count, random);
    std::vector<IndexRange> ranges(index_stretches(count) + 1, IndexRange{7, 7});
    find_index_ranges(indices.data(), count, ranges.data());
    for (size_t i = 0; i < index_stretches(count); ++i) {
      const size_t first = i * kIndexStretch, end = std::min(count, first + kIndexStretch);
      const IndexRange range = index_range(indices.data() + first, uint32_t(end - first));
      EXPECT_EQ(ranges[i].lowest, range.lowest) << count << " " << i;
      EXPECT_EQ(ranges[i].highest, range.highest) << count << " " << i;
    }
    EXPECT_EQ(ranges.back().lowest, 7u) << count;
    const IndexRange all = joined_range(ranges.data(), index_stretches(count));
    EXPECT_EQ(all.lowest, *std::min_element(indices.begin(), indices.end())) << count;
    EXPECT_EQ(all.highest, *std::max_element(indices.begin(), indices.end())) << count;
  }
}

INSTANTIATE_TEST_SUITE_P(Isa, IndexPart, testing::ValuesIn(levels()), [](const auto& level) { return level.param; });

}  // namespace
}  // namespace halfspace::raster::test
