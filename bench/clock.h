// The two clocks of the benchmark.
#pragma once

namespace halfspace::bench {

struct Times {
  double cpu_ms = 0;  // of all threads of this process and of the children it waited for
  double wall_ms = 0;
};

// Since some fixed moment; the difference of two is what matters.
Times now();

inline Times operator-(const Times& a, const Times& b) {
  return {a.cpu_ms - b.cpu_ms, a.wall_ms - b.wall_ms};
}

}  // namespace halfspace::bench
