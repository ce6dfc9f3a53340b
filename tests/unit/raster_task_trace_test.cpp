// raster/task_trace.h: what is written is the tasks' own time, without that of the clock they are timed with.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "raster/task_trace.h"

namespace {

using namespace halfspace::raster;

std::vector<uint64_t> times_of(const std::filesystem::path& file, const std::string& event) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string name;
    words >> name;
    if (name != event) continue;
    std::vector<uint64_t> times;
    for (uint64_t time; words >> time;) times.push_back(time);
    return times;
  }
  return {};
}

TEST(TaskTrace, ClockIsNotInTheTimes) {
  const auto file = std::filesystem::temp_directory_path() / ("task_trace_" + std::to_string(getpid()));
  constexpr uint32_t kTasks = 1000;
  constexpr uint64_t kLong = 1'000'000'000;
  uint64_t measured = 0;
  {
    TaskTrace trace(file.string(), 2);
    uint64_t* times = trace.begin_back(kTasks + 2);
    for (uint32_t i = 0; i < kTasks; ++i) {
      const uint64_t start = thread_nanoseconds();
      times[i] = thread_nanoseconds() - start;
      measured += times[i];
    }
    times[kTasks] = kLong;
    times[kTasks + 1] = 0;
  }
  const std::vector<uint64_t> written = times_of(file, "back");
  std::filesystem::remove(file);
  ASSERT_EQ(written.size(), kTasks + 2);
  uint64_t left = 0;
  for (uint32_t i = 0; i < kTasks; ++i) left += written[i];
  EXPECT_LT(left, measured / 2) << "of tasks that do nothing";
  EXPECT_LT(kLong - written[kTasks], kLong / 100);
  EXPECT_EQ(written[kTasks + 1], 0u) << "a task that was not done";
}

}  // namespace
