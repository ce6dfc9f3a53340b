#include "compare/core_distance.h"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace halfspace::compare {
namespace {

constexpr int kRounds = 100, kTripsARound = 50;

void stay_on(int core) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<size_t>(core), &set);
  pthread_setaffinity_np(pthread_self(), sizeof set, &set);
}

// Lets others run now and then: the one that is waited for may need this core.
void wait_for(const std::atomic<int>& line, int value) {
  for (int looks = 1; line.load() != value; ++looks)
    if (looks % 10'000 == 0) std::this_thread::yield();
}

}  // namespace

double core_distance(int core, int other) {
  using Clock = std::chrono::steady_clock;
  alignas(64) std::array<std::atomic<int>, 16> line{};  // all of it
  constexpr int kTrips = kRounds * kTripsARound;
  std::thread answering([&] {
    stay_on(other);
    for (int i = 0; i < kTrips; ++i) {
      wait_for(line[0], 2 * i + 1);
      line[0].store(2 * i + 2);
    }
  });
  std::vector<double> times;
  std::thread asking([&] {
    stay_on(core);
    for (int round = 0, i = 0; round < kRounds; ++round) {
      const auto start = Clock::now();
      for (int trip = 0; trip < kTripsARound; ++trip, ++i) {
        line[0].store(2 * i + 1);
        wait_for(line[0], 2 * i + 2);
      }
      times.push_back(std::chrono::duration<double, std::nano>(Clock::now() - start).count() / kTripsARound);
    }
  });
  asking.join();
  answering.join();
  std::nth_element(times.begin(), times.begin() + kRounds / 2, times.end());
  return times[kRounds / 2];
}

}  // namespace halfspace::compare
