// What is drawn more and more of, to see how time and memory grow; the list is scales.def.
#pragma once

#include <string>
#include <vector>

#include "bench/workload.h"

namespace halfspace::bench {

struct Scale {
  const char* name;
  const char* what;          // is drawn
  std::vector<int> amounts;  // ascending
  Frame (*prepare)(int amount, Screen);
};

const std::vector<Scale>& all_scales();

// Throws std::runtime_error when there is none.
const Scale& scale_named(const std::string& name);

// `edge` is the amount of the scale `pixels`; else the benchmark's screen.
Screen screen_of(const Scale& scale, int amount, Screen usual);

}  // namespace halfspace::bench
