// The simulated schedule, on traces whose outcome is worked out by hand.
#include "compare/schedule.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace halfspace::compare {
namespace {

// Nanoseconds in the trace; milliseconds out.
Schedule frame(const std::string& events, int cores, double wake_us = 0) {
  std::istringstream in("pool 4\nserial 7000\npicture\n" + events + "picture\n");
  return simulate(read_trace(in), cores, wake_us);
}

TEST(Schedule, OneCoreDoesEverythingInTurn) {
  const Schedule schedule =
      frame("serial 1000000\nfront 2000000 3000000\nback 4000000 5000000\nserial 6000000\nwait\n", 1);
  EXPECT_DOUBLE_EQ(schedule.frame_ms, 21);
  EXPECT_DOUBLE_EQ(schedule.work_ms, 21);
  EXPECT_DOUBLE_EQ(schedule.serial_share, 7.0 / 21);
}

TEST(Schedule, AFrontLoopLastsAsLongAsItsLongestWorker) {
  const std::string loop = "front 4000000 3000000 2000000 1000000\n";
  EXPECT_DOUBLE_EQ(frame(loop, 2).frame_ms, 5);  // 4 + 1 and 3 + 2
  EXPECT_DOUBLE_EQ(frame(loop, 64).frame_ms, 4);
}

TEST(Schedule, TheBackGoesOnBesideTheCaller) {
  // The helper does both tasks while the caller is busy.
  EXPECT_DOUBLE_EQ(frame("back 2000000 3000000\nserial 6000000\nwait\n", 2).frame_ms, 6);
  // The caller comes back after 1 and takes the second.
  EXPECT_DOUBLE_EQ(frame("back 2000000 3000000\nserial 1000000\nwait\n", 2).frame_ms, 4);
  // What has begun is finished: the second is with the helper, the caller takes the third.
  EXPECT_DOUBLE_EQ(frame("back 1000000 5000000 2000000\nserial 2000000\nwait\n", 2).frame_ms, 6);
}

TEST(Schedule, APreparationComesBeforeTheTasks) {
  // The helper prepares until 3 and has both tasks done at 8, while the caller is busy.
  const std::string prepared = "prepare 3000000\nback 2000000 3000000\n";
  EXPECT_DOUBLE_EQ(frame(prepared + "serial 9000000\nwait\n", 2).frame_ms, 9);
  // The caller comes back after 1, waits until 3, and takes one of the tasks.
  EXPECT_DOUBLE_EQ(frame(prepared + "serial 1000000\nwait\n", 2).frame_ms, 6);
  EXPECT_DOUBLE_EQ(frame(prepared + "serial 1000000\nwait\n", 1).frame_ms, 9);
  // The helper does not wake before the caller has nothing else to do.
  EXPECT_DOUBLE_EQ(frame(prepared + "serial 1000000\nwait\n", 2, 2000).frame_ms, 7);
  EXPECT_DOUBLE_EQ(frame(prepared + "wait\n", 2).serial_share, 0);
}

TEST(Schedule, TheFrontGoesFirst) {
  // The helper has begun with the back when the loop opens at 1; until 4 the caller is alone with the front's
  // four tasks, and then has one left to do, which the helper begins at the same time as the caller could: 5.
  // The back's second task begins at 4 with the helper only if no front task is left.
  EXPECT_DOUBLE_EQ(
      frame("back 4000000 1000000\nserial 1000000\nfront 2000000 2000000 2000000\nwait\n", 2).frame_ms, 7);
}

TEST(Schedule, WakingTakesTime) {
  EXPECT_DOUBLE_EQ(frame("front 1000000 1000000\n", 2, 500).frame_ms, 1.5);
  // Not worth the wait.
  EXPECT_DOUBLE_EQ(frame("front 1000000 1000000\n", 2, 5000).frame_ms, 2);
}

TEST(Schedule, WhatIsNotATraceIsAnError) {
  std::istringstream words("pool 2\nbehind 3\n"), letters("pool 2\nback 1 x\n"), none("pool 2\n"),
      two("pool 2\nprepare 1 2\n");
  EXPECT_THROW(read_trace(two), std::runtime_error);
  EXPECT_THROW(read_trace(words), std::runtime_error);
  EXPECT_THROW(read_trace(letters), std::runtime_error);
  EXPECT_THROW(simulate(read_trace(none), 2, 0), std::runtime_error);
}

}  // namespace
}  // namespace halfspace::compare
