// The loops of raster/thread_pool.h: every task once, whichever threads come to do it.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <span>
#include <stdexcept>
#include <thread>
#include <vector>

#include "raster/thread_pool.h"

namespace {

using halfspace::raster::ThreadPool;

// How often each task was done.
struct Tally {
  explicit Tally(uint32_t count) : done(count) {}
  void expect_each(int times) const {
    for (size_t i = 0; i < done.size(); ++i) ASSERT_EQ(done[i].load(), times) << "task " << i;
  }
  std::vector<std::atomic<int>> done;
};

// Ends of equal stretches, but for the last worker, who gets none.
std::vector<uint32_t> lopsided(uint32_t count, int workers) {
  std::vector<uint32_t> ends(static_cast<size_t>(workers), count);
  for (size_t i = 0; i + 1 < ends.size(); ++i)
    ends[i] = count * static_cast<uint32_t>(i + 1) / static_cast<uint32_t>(workers);
  if (workers > 1) ends[ends.size() - 2] = count;
  return ends;
}

class ThreadPoolTest : public testing::TestWithParam<int> {
 protected:
  ThreadPool pool{GetParam()};
};

TEST_P(ThreadPoolTest, RunDoesEachTaskOnce) {
  for (const uint32_t count : {0u, 1u, 2u, 7u, 1000u}) {
    Tally tally(count);
    pool.run(count, [&](uint32_t i, int worker) {
      ASSERT_GE(worker, 0);
      ASSERT_LT(worker, pool.size());
      ++tally.done[i];
    });
    tally.expect_each(1);
  }
}

TEST_P(ThreadPoolTest, WhatWasStartedIsDoneOnceWaitedFor) {
  Tally tally(257);
  for (int round = 1; round <= 50; ++round) {
    pool.start(lopsided(257, pool.size()), [&](uint32_t i, int) { ++tally.done[i]; });
    pool.wait();
    tally.expect_each(round);
  }
}

TEST_P(ThreadPoolTest, RunsAreDoneBesideWhatWasStarted) {
  Tally behind(64), before(500);
  for (int round = 1; round <= 40; ++round) {
    pool.start(lopsided(64, pool.size()), [&](uint32_t i, int) {
      ++behind.done[i];
      if (i % 16 == 0) std::this_thread::yield();
    });
    for (int part = 0; part < 5; ++part)
      pool.run(100, [&](uint32_t i, int) { ++before.done[static_cast<uint32_t>(part) * 100 + i]; });
    before.expect_each(round);
  }
  pool.wait();
  behind.expect_each(40);
}

// What a task wrote is seen after wait(), without atomics.
TEST_P(ThreadPoolTest, ResultsAreVisible) {
  std::vector<uint32_t> values(4096, 0);
  for (uint32_t round = 1; round <= 20; ++round) {
    pool.start(lopsided(4096, pool.size()), [&](uint32_t i, int) { values[i] += i; });
    pool.wait();
    for (uint32_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], i * round);
  }
}

TEST_P(ThreadPoolTest, AnExceptionComesOutAfterAllOthersAreDone) {
  Tally tally(100);
  const auto task = [&](uint32_t i, int) {
    ++tally.done[i];
    if (i == 41) throw std::runtime_error("41");
  };
  EXPECT_THROW(pool.start(lopsided(100, pool.size()), task); pool.wait(), std::runtime_error);
  EXPECT_NO_THROW(pool.wait());
  pool.run(3, [](uint32_t, int) {});  // and all goes on
  if (pool.size() > 1) tally.expect_each(1);
}

TEST_P(ThreadPoolTest, SleepersWake) {
  Tally tally(32);
  for (int round = 1; round <= 3; ++round) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    pool.run(32, [&](uint32_t i, int) { ++tally.done[i]; });
    tally.expect_each(round);
  }
}

TEST_P(ThreadPoolTest, APoolMayGoWhileItsTasksAreOpen) {
  auto tally = std::make_unique<Tally>(64);
  {
    ThreadPool other(GetParam());
    other.start(lopsided(64, other.size()), [&](uint32_t i, int) { ++tally->done[i]; });
  }
  tally->expect_each(1);
}

// What has to be done before the tasks are known is done once, by whoever it is, and all of them see it.
TEST_P(ThreadPoolTest, WhatIsPreparedIsThereForTheTasks) {
  std::vector<uint32_t> values, done;
  std::vector<uint32_t> ends;
  for (uint32_t round = 1; round <= 200; ++round) {
    const uint32_t count = round * 7 % 50;
    const auto prepare = [&, count, round] {
      values.assign(count, round);
      done.assign(count, 0);
      ends = lopsided(count, pool.size());
      return std::span<const uint32_t>(ends);
    };
    pool.start(prepare, [&](uint32_t i, int) { done[i] += values[i]; });
    if (round % 3 == 0) std::this_thread::yield();
    if (round % 5 == 0) pool.run(4, [](uint32_t, int) {});
    pool.wait();
    ASSERT_EQ(done, std::vector<uint32_t>(count, round));
  }
}

TEST_P(ThreadPoolTest, AFailedPreparationComesOutAndLeavesNoTask) {
  Tally tally(8);
  const auto fail = []() -> std::span<const uint32_t> { throw std::runtime_error("prepared"); };
  EXPECT_THROW(pool.start(fail, [&](uint32_t i, int) { ++tally.done[i]; }); pool.wait(), std::runtime_error);
  EXPECT_NO_THROW(pool.wait());
  tally.expect_each(0);
  pool.start(lopsided(8, pool.size()), [&](uint32_t i, int) { ++tally.done[i]; });
  pool.wait();
  tally.expect_each(1);
}

TEST_P(ThreadPoolTest, APoolMayGoBeforeAnythingIsPrepared) {
  auto tally = std::make_unique<Tally>(64);
  std::vector<uint32_t> ends;
  {
    ThreadPool other(GetParam());
    const auto prepare = [&] {
      ends = lopsided(64, other.size());
      return std::span<const uint32_t>(ends);
    };
    other.start(prepare, [&](uint32_t i, int) { ++tally->done[i]; });
  }
  tally->expect_each(1);
}

INSTANTIATE_TEST_SUITE_P(Threads, ThreadPoolTest, testing::Values(1, 2, 3, 8),
                         [](const auto& at) { return std::to_string(at.param) + "_threads"; });

}  // namespace
