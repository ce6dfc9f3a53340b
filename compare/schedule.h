// How a trace of tasks (HALFSPACE_TRACE, raster/task_trace.h) would go on any number of cores.
#pragma once

#include <istream>
#include <string>
#include <vector>

namespace halfspace::compare {

struct TraceEvent {
  enum class Kind { serial, front, prepare, back, wait, picture } kind;
  std::vector<double> tasks_us;  // of serial and prepare: the one time
};

struct Trace {
  int threads = 0;  // of the pool it was recorded with
  std::vector<TraceEvent> events;
};

// Of the last pool in the stream that did anything. Throws std::runtime_error for what is not a trace.
Trace read_trace(std::istream& in);

struct Schedule {
  double frame_ms = 0;      // median between pictures
  double work_ms = 0;       // of a frame, all tasks and what is between them, on one core
  double serial_share = 0;  // of the work: outside of loops
};

// The caller and `cores` - 1 helpers, a core each, do the recorded tasks as ThreadPool does: a loop of the
// front goes before the one at the back, and whoever is free takes the next task. What prepares a back is
// done by the first who is free, before any of its tasks. A helper begins with a loop `wake_us` after it was
// opened. What the cores cost each other, in memory traffic above all, is left out. Two pictures at least.
Schedule simulate(const Trace& trace, int cores, double wake_us);

}  // namespace halfspace::compare
