// What it costs a thread to write memory that another one has read.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace halfspace::raster {

// Threads whose cores share a cache hand memory to and fro for little. Where they share none (a large
// processor has several last-level caches, and a virtual machine may be moved from one to two of them at any
// moment), each line that is written while another core still has it is waited for: 20 to 30 ns, one after
// the other, instead of two.
class CacheDistance {
 public:
  // Whether the processor can have memory leave the caches. If not, no distance is measured.
  static bool can_leave();
  // By another thread than the writer.
  void read();
  // By the writer: takes the time to write what has been read meanwhile, if anything was.
  void measure();
  // Whether the last measurement found no cache in common.
  bool is_far() const { return far_; }

 private:
  struct alignas(64) Line {
    std::atomic<uint32_t> value{0};
  };
  std::array<Line, 32> lines_;
  alignas(64) std::atomic<bool> was_read_{false};
  const bool measures_ = can_leave();
  bool far_ = false;
};

// Has memory leave all caches, the other threads' too, so that writing it costs nobody more than a miss. For
// processors that can.
void leave_caches(const void* from, size_t bytes);

}  // namespace halfspace::raster
