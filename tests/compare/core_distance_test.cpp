// What a line of memory takes from core to core lies where such times lie.
#include "compare/core_distance.h"

#include <gtest/gtest.h>

#include "compare/process.h"

namespace halfspace::compare {
namespace {

TEST(CoreDistance, IsATimeOfCaches) {
  const std::vector<int> cores = available_cores();
  if (cores.size() < 2) GTEST_SKIP() << "one core";
  const double ns = core_distance(cores[0], cores[1]);
  EXPECT_GT(ns, 5);
  EXPECT_LT(ns, 1e6);
}

}  // namespace
}  // namespace halfspace::compare
