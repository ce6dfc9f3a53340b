// The memory of a display list: it only grows, and goes away as a whole.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace halfspace::state {

class ListMemory {
 public:
  // `bytes` bytes, aligned for anything. May throw std::bad_alloc.
  void* allocate(size_t bytes) {
    const size_t units = (bytes + sizeof(Unit) - 1) / sizeof(Unit);
    if (units > free_units_) add_block(units);
    void* start = next_;
    next_ += units;
    free_units_ -= units;
    return start;
  }

  // Nothing here is ever destroyed, only its memory goes back.
  template <class T, class... Arguments>
  T* make(Arguments&&... arguments) {
    static_assert(std::is_trivially_destructible_v<T> && alignof(T) <= alignof(Unit));
    return new (allocate(sizeof(T))) T{std::forward<Arguments>(arguments)...};
  }

  // A copy of `count` elements; null stays null, and none are none.
  template <class T>
  const T* copy(const T* source, size_t count) {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= alignof(Unit));
    if (source == nullptr || count == 0) return nullptr;
    return static_cast<const T*>(std::memcpy(allocate(count * sizeof(T)), source, count * sizeof(T)));
  }

 private:
  struct alignas(std::max_align_t) Unit {
    std::byte bytes[alignof(std::max_align_t)];
  };
  static constexpr size_t kFirstBlockUnits = 32, kLargestBlockUnits = 4096;

  // Lists of a character and lists of a million vertices: blocks grow with the list.
  void add_block(size_t units) {
    const size_t wanted = std::max(units, block_units_);
    blocks_.reserve(blocks_.size() + 1);
    blocks_.emplace_back(new Unit[wanted]);
    next_ = blocks_.back().get();
    free_units_ = wanted;
    block_units_ = std::min(block_units_ * 2, kLargestBlockUnits);
  }

  std::vector<std::unique_ptr<Unit[]>> blocks_;
  Unit* next_ = nullptr;
  size_t free_units_ = 0, block_units_ = kFirstBlockUnits;
};

}  // namespace halfspace::state
