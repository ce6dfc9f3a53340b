// Memory that lives until the pass is finished: handed out in order, taken back all at once, kept for the next pass.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

#include "raster/surface/page_buffer.h"

namespace halfspace::raster {

class Arena {
 public:
  // 64-byte aligned; throws std::bad_alloc.
  std::byte* allocate(size_t bytes) {
    bytes = (bytes + 63) & ~size_t{63};
    while (at_ < buffers_.size() && used_ + bytes > buffers_[at_].bytes()) {
      ++at_;
      used_ = 0;
    }
    if (at_ == buffers_.size()) {
      buffers_.emplace_back(bytes > kBufferBytes ? bytes : kBufferBytes);
      used_ = 0;
    }
    std::byte* p = buffers_[at_].as<std::byte>() + used_;
    used_ += bytes;
    total_ += bytes;
    return p;
  }
  // Takes back what was allocated last.
  void take_back(size_t bytes) {
    bytes = (bytes + 63) & ~size_t{63};
    used_ -= bytes;
    total_ -= bytes;
  }
  size_t bytes_in_use() const { return total_; }
  // visit(begin, bytes) for the memory that was handed out, and for what was left over at the ends of
  // buffers.
  template <class Visit>
  void for_each_used(Visit visit) const {
    for (size_t i = 0; i < buffers_.size() && i <= at_; ++i)
      visit(buffers_[i].as<std::byte>(), i < at_ ? buffers_[i].bytes() : used_);
  }
  void reset() {
    // Buffers of unusual size are not kept.
    std::erase_if(buffers_, [](const PageBuffer& b) { return b.bytes() > kLargestKept; });
    at_ = used_ = total_ = 0;
  }

 private:
  static constexpr size_t kBufferBytes = size_t{1} << 18;
  static constexpr size_t kLargestKept = size_t{8} << 20;
  std::vector<PageBuffer> buffers_;
  size_t at_ = 0, used_ = 0, total_ = 0;
};

}  // namespace halfspace::raster
