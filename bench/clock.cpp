#include "bench/clock.h"

#include <sys/resource.h>

#include <ctime>

namespace halfspace::bench {
namespace {

double milliseconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

double milliseconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_usec) * 1e-3;
}

}  // namespace

Times now() {
  rusage children{};
  getrusage(RUSAGE_CHILDREN, &children);
  return {milliseconds(CLOCK_PROCESS_CPUTIME_ID) + milliseconds(children.ru_utime) +
              milliseconds(children.ru_stime),
          milliseconds(CLOCK_MONOTONIC)};
}

}  // namespace halfspace::bench
