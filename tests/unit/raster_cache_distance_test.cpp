// raster/cache_distance.h, and what a batch has leave the caches.
#include <gtest/gtest.h>

#include <cstring>
#include <thread>
#include <utility>
#include <vector>

#include "raster/arena.h"
#include "raster/cache_distance.h"

namespace {

using namespace halfspace::raster;

TEST(CacheDistance, MemoryKeepsWhatItHolds) {
  if (!CacheDistance::can_leave()) GTEST_SKIP() << "the processor has no such instruction";
  std::vector<unsigned char> bytes(1000);
  for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(i * 7);
  const std::vector<unsigned char> before = bytes;
  for (const size_t first : {0u, 1u, 63u, 64u})
    for (const size_t count : {0u, 1u, 63u, 64u, 65u, 900u}) leave_caches(bytes.data() + first, count);
  leave_caches(nullptr, 0);
  EXPECT_EQ(bytes, before);
}

// Of many tries one is not interrupted.
bool is_ever_near(CacheDistance& distance) {
  for (int i = 0; i < 100; ++i) {
    distance.read();
    distance.measure();
    if (!distance.is_far()) return true;
  }
  return false;
}

TEST(CacheDistance, AThreadIsNearItself) {
  CacheDistance distance;
  EXPECT_FALSE(distance.is_far());
  EXPECT_TRUE(is_ever_near(distance));
}

// Far or not, what was not read is not measured: the answer stands.
TEST(CacheDistance, StandsUntilSomebodyReads) {
  CacheDistance distance;
  std::thread([&] { distance.read(); }).join();
  distance.measure();
  const bool far = distance.is_far();
  for (int i = 0; i < 10; ++i) {
    distance.measure();
    EXPECT_EQ(distance.is_far(), far);
  }
}

TEST(Arena, VisitsAllThatIsUsed) {
  Arena arena;
  std::vector<std::pair<const std::byte*, size_t>> given;
  const auto expect_visited = [&] {
    for (const auto& [begin, bytes] : given) {
      bool found = false;
      arena.for_each_used([&, at = begin, size = bytes](const std::byte* from, size_t used) {
        found |= at >= from && at + size <= from + used;
      });
      EXPECT_TRUE(found) << bytes << " bytes";
    }
  };
  for (int round = 0; round < 2; ++round) {
    for (const size_t bytes : {64u, 1u, 200'000u, 100'000u, 1'000'000u, 100u})
      given.emplace_back(arena.allocate(bytes), bytes);
    expect_visited();
    arena.take_back(100);
    given.pop_back();
    expect_visited();
    arena.reset();
    given.clear();
    size_t visited = 0;
    arena.for_each_used([&](const std::byte*, size_t used) { visited += used; });
    EXPECT_EQ(visited, 0u);
  }
}

}  // namespace
