#include "raster/cache_distance.h"

#include <chrono>

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace halfspace::raster {
namespace {

// Measured on two cores of a Zen 4: 2.7 ns with a cache in common, 20 or more without.
constexpr std::chrono::nanoseconds kFarLine{10};

}  // namespace

bool CacheDistance::can_leave() {
#if defined(__x86_64__)
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (b & bit_CLFLUSHOPT) != 0;
#else
  return false;
#endif
}

void CacheDistance::read() {
  for (const Line& line : lines_) line.value.load(std::memory_order_relaxed);
  was_read_.store(true, std::memory_order_release);
}

void CacheDistance::measure() {
  if (!measures_ || !was_read_.load(std::memory_order_acquire)) return;
  const auto start = std::chrono::steady_clock::now();
  for (Line& line : lines_) line.value.store(1, std::memory_order_relaxed);
  was_read_.store(false, std::memory_order_seq_cst);  // waits until the others have arrived
  const auto time = std::chrono::steady_clock::now() - start;
  far_ = time > kFarLine * lines_.size();
}

void leave_caches(const void* from, size_t bytes) {
#if defined(__x86_64__)
  if (bytes == 0) return;
  constexpr uintptr_t kLine = 64;
  const auto begin = reinterpret_cast<uintptr_t>(from) & ~(kLine - 1);
  for (uintptr_t at = begin; at < reinterpret_cast<uintptr_t>(from) + bytes; at += kLine)
    asm volatile("clflushopt %0" : : "m"(*reinterpret_cast<const char*>(at)) : "memory");
#else
  static_cast<void>(from), static_cast<void>(bytes);
#endif
}

}  // namespace halfspace::raster
