// What a pool of threads did, for a simulation of how it would go on other numbers of cores.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace halfspace::raster {

// CPU time of the calling thread: how long something takes when nobody else wants the core.
uint64_t thread_nanoseconds();
// What it adds to a time that is taken with it: a microsecond where the system is asked, which is more than
// many a tile takes.
uint64_t thread_clock_cost();

// Events of the thread that owns the pool, in order. Written to HALFSPACE_TRACE when the pool ends, a line
// each; times are nanoseconds of CPU time:
//   pool THREADS
//   serial T        outside of loops, since the event before
//   front T T T...  a loop that was waited for, with its tasks
//   prepare T       what has to be done, once, before the tasks of the next `back`; by anybody
//   back T T T...   a loop that was begun, with its tasks
//   wait            until the tasks of the last `back` were done
//   picture         one was shown
class TaskTrace {
 public:
  // Null unless HALFSPACE_TRACE names a file.
  static std::unique_ptr<TaskTrace> create(int threads);
  TaskTrace(const std::string& path, int threads);
  ~TaskTrace();
  TaskTrace(const TaskTrace&) = delete;
  TaskTrace& operator=(const TaskTrace&) = delete;

  // Where the tasks of a loop that begins now leave their times; valid until it has ended.
  uint64_t* begin_front(uint32_t tasks);
  void end_front();
  uint64_t* begin_prepare();  // until begin_back()
  uint64_t* begin_back(uint32_t tasks);
  void begin_wait();
  void end_wait();
  void picture();

 private:
  struct Event {
    const char* name;
    std::unique_ptr<uint64_t[]> times;
    uint32_t count = 0;
  };
  void end_serial();
  uint64_t* add(const char* name, uint32_t count);

  std::FILE* file_;
  const uint64_t clock_cost_;  // in each time, until they are written
  std::vector<Event> events_;
  uint64_t serial_since_;
  bool prepares_ = false;
};

}  // namespace halfspace::raster
