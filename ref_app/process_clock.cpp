#include "ref_app/process_clock.h"

#include <cstdlib>
#include <ctime>
#include <fstream>

namespace ref_app {
namespace {

constexpr const char* kStartVariable = "REF_APP_START_NS";

long long start_ns = 0;
bool from_environment = false;

long long read_clock(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return time.tv_sec * 1'000'000'000LL + time.tv_nsec;
}

}  // namespace

void note_process_start() {
  const long long now = read_clock(CLOCK_MONOTONIC);
  start_ns = now - read_clock(CLOCK_PROCESS_CPUTIME_ID);
  if (const char* given = std::getenv(kStartVariable)) {
    const long long value = std::strtoll(given, nullptr, 10);
    from_environment = value > 0 && value <= now;
    if (from_environment) start_ns = value;
  }
}

void export_process_start() { setenv(kStartVariable, std::to_string(start_ns).c_str(), 0); }

double milliseconds_since_process_start() {
  return static_cast<double>(read_clock(CLOCK_MONOTONIC) - start_ns) * 1e-6;
}

double processor_milliseconds() { return static_cast<double>(read_clock(CLOCK_PROCESS_CPUTIME_ID)) * 1e-6; }

std::string process_start_source() { return from_environment ? "environment" : "estimate"; }

long peak_memory_kib() {
  // "VmHWM:     12345 kB", proc(5). Not getrusage's ru_maxrss: execve leaves that at what the parent held at fork.
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    long kib = 0;
    if (word == "VmHWM:" && status >> kib) return kib;
  }
  return 0;
}

}  // namespace ref_app
