// The workloads: what each draws is in workloads_*.cpp, one function each; their list is workloads.def.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bench/library.h"

namespace halfspace::bench {

// Draws one frame, glFinish included.
using Frame = std::function<void()>;

struct Workload {
  const char* name;
  double target;        // how many times as fast as llvmpipe at one thread it has to be
  double draft_target;  // the same at draft accuracy; 0: not asked
  const char* what;
  // Sets the state up in a fresh context that is current, makes the geometry, and returns what draws it.
  Frame (*prepare)(Screen);
};

const std::vector<Workload>& all_workloads();

// What a frame of it cannot do without, at 1024x1024: amounts by the names of the benchmarks in limits.cpp.
std::map<std::string, double> work_of(const std::string& workload);

// Throws std::runtime_error that names those there are.
const Workload& workload_named(const std::string& name);

}  // namespace halfspace::bench
