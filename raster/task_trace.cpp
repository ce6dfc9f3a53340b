#include "raster/task_trace.h"

#include <algorithm>
#include <cinttypes>
#include <cstdlib>
#include <ctime>
#include <utility>

namespace halfspace::raster {

uint64_t thread_nanoseconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<uint64_t>(time.tv_sec) * 1'000'000'000u + static_cast<uint64_t>(time.tv_nsec);
}

uint64_t thread_clock_cost() {
  uint64_t least = ~uint64_t{0};
  for (int i = 0; i < 100; ++i) {
    const uint64_t start = thread_nanoseconds();
    least = std::min(least, thread_nanoseconds() - start);
  }
  return least;
}

std::unique_ptr<TaskTrace> TaskTrace::create(int threads) {
  const char* path = std::getenv("HALFSPACE_TRACE");
  return path == nullptr || *path == '\0' ? nullptr : std::make_unique<TaskTrace>(path, threads);
}

TaskTrace::TaskTrace(const std::string& path, int threads)
    : file_(std::fopen(path.c_str(), "a")),
      clock_cost_(thread_clock_cost()),
      serial_since_(thread_nanoseconds()) {
  if (file_ == nullptr)
    std::perror(("halfspace: HALFSPACE_TRACE=" + path).c_str());
  else
    std::fprintf(file_, "pool %d\n", threads);
}

TaskTrace::~TaskTrace() {
  if (file_ == nullptr) return;
  for (const Event& event : events_) {
    std::fputs(event.name, file_);
    for (uint32_t i = 0; i < event.count; ++i)
      std::fprintf(file_, " %" PRIu64, event.times[i] - std::min(event.times[i], clock_cost_));
    std::fputc('\n', file_);
  }
  std::fclose(file_);
}

uint64_t* TaskTrace::add(const char* name, uint32_t count) {
  events_.push_back({name, std::make_unique<uint64_t[]>(count), count});
  return events_.back().times.get();
}

void TaskTrace::end_serial() { *add("serial", 1) = thread_nanoseconds() - serial_since_; }

uint64_t* TaskTrace::begin_front(uint32_t tasks) {
  end_serial();
  return add("front", tasks);
}

void TaskTrace::end_front() { serial_since_ = thread_nanoseconds(); }

uint64_t* TaskTrace::begin_prepare() {
  end_serial();
  prepares_ = true;
  return add("prepare", 1);
}

uint64_t* TaskTrace::begin_back(uint32_t tasks) {
  if (!std::exchange(prepares_, false)) end_serial();
  serial_since_ = thread_nanoseconds();
  return add("back", tasks);
}

void TaskTrace::begin_wait() {
  end_serial();
  add("wait", 0);
}

void TaskTrace::end_wait() { serial_since_ = thread_nanoseconds(); }

void TaskTrace::picture() {
  end_serial();
  add("picture", 0);
  serial_since_ = thread_nanoseconds();
}

}  // namespace halfspace::raster
