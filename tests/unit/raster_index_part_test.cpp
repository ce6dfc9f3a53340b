// The range of indices and indices counted from its lowest, on every instruction set and at every length about a vector's.
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

TEST_P(IndexPart, RebaseWritesAsManyAsThereAre) {
  std::mt19937 random(2);
  for (uint32_t count = 0; count < 70; ++count) {
    const std::vector<uint32_t> indices = some_indices(count, random);
    std::vector<uint32_t> out(count + 1, 7);
    rebase_indices(indices.data(), count, 12345, out.data());
    for (uint32_t i = 0; i < count; ++i) EXPECT_EQ(out[i], indices[i] - 12345) << count;
    EXPECT_EQ(out[count], 7u);
  }
}

INSTANTIATE_TEST_SUITE_P(Isa, IndexPart, testing::ValuesIn(levels()), [](const auto& level) { return level.param; });

}  // namespace
}  // namespace halfspace::raster::test
