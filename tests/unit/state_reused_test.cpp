// Draws' states, which are handed out again as they were.
#include "state/derive/reused.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <vector>

namespace {

using halfspace::state::Reused;

struct Object {
  int kept = 0;
  std::shared_ptr<int> held;
  void retire() { held.reset(); }
};

TEST(ReusedTest, ComesBackAsItWasWithoutWhatItHeld) {
  Reused<Object> objects;
  const auto held = std::make_shared<int>(7);
  auto first = objects.take();
  Object* const place = first.get();
  first->kept = 5;
  first->held = held;
  const auto second = objects.take();
  EXPECT_NE(second.get(), place);
  EXPECT_EQ(second->kept, 0);
  first.reset();
  EXPECT_EQ(objects.kept(), 1u);
  EXPECT_EQ(held.use_count(), 1);
  const auto third = objects.take();
  EXPECT_EQ(third.get(), place);
  EXPECT_EQ(third->kept, 5);
  EXPECT_EQ(objects.kept(), 0u);
}

TEST(ReusedTest, TheLatestComesFirst) {
  Reused<Object> objects;
  auto first = objects.take(), second = objects.take();
  Object* const place = first.get();
  second.reset();
  first.reset();
  EXPECT_EQ(objects.take().get(), place);
}

TEST(ReusedTest, KeepsABoundedNumber) {
  Reused<Object> objects;
  std::vector<std::shared_ptr<Object>> many;
  for (int i = 0; i < 5000; ++i) many.push_back(objects.take());
  many.clear();
  EXPECT_GT(objects.kept(), 0u);
  EXPECT_LT(objects.kept(), 1000u);
}

TEST(ReusedTest, ObjectsOutliveIt) {
  std::optional<Reused<Object>> objects(std::in_place);
  auto first = objects->take(), second = objects->take();
  objects->take();
  second->kept = 2;
  objects.reset();
  first.reset();
  EXPECT_EQ(second->kept, 2);
}

}  // namespace
