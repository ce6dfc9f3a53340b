// The memory that draws' states come from.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "state/derive/block_pool.h"

namespace {

using halfspace::state::BlockPool;
using Object = std::array<int, 700>;

std::shared_ptr<Object> make(BlockPool& pool, int value) {
  auto object = std::allocate_shared<Object>(BlockPool::Allocator<Object>(pool));
  object->fill(value);
  return object;
}

TEST(BlockPoolTest, GivesOutWhatCameBack) {
  BlockPool pool;
  auto first = make(pool, 1);
  const Object* const place = first.get();
  const auto second = make(pool, 2);
  first.reset();
  EXPECT_EQ(pool.kept(), 1u);
  const auto third = make(pool, 3);
  EXPECT_EQ(third.get(), place);
  EXPECT_EQ(pool.kept(), 0u);
  EXPECT_EQ((*second)[699], 2);
  EXPECT_EQ((*third)[699], 3);
}

TEST(BlockPoolTest, KeepsABoundedNumber) {
  BlockPool pool;
  std::vector<std::shared_ptr<Object>> many;
  for (int i = 0; i < 5000; ++i) many.push_back(make(pool, i));
  many.clear();
  EXPECT_GT(pool.kept(), 0u);
  EXPECT_LT(pool.kept(), 1000u);
}

TEST(BlockPoolTest, ObjectsOfAnotherSizeAreNotKept) {
  BlockPool pool;
  make(pool, 1);
  const size_t kept = pool.kept();
  auto other = std::allocate_shared<char>(BlockPool::Allocator<char>(pool), 'x');
  EXPECT_EQ(pool.kept(), kept);
  other.reset();
  EXPECT_EQ(pool.kept(), kept);
}

TEST(BlockPoolTest, ObjectsOutliveIt) {
  std::optional<BlockPool> pool(std::in_place);
  auto first = make(*pool, 1), second = make(*pool, 2);
  make(*pool, 3);
  pool.reset();
  EXPECT_EQ((*first)[0], 1);
  first.reset();
  EXPECT_EQ((*second)[699], 2);
}

}  // namespace
