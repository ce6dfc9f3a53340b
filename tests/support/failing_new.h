// Replaces operator new and delete of the program that includes this, in one source file only, so that a
// chosen allocation fails with std::bad_alloc.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

namespace halfspace::test {

// How many more allocations of this thread succeed; negative: all.
inline thread_local int allocations_left = -1;
inline thread_local bool allocation_failed = false;

inline void* allocate(std::size_t size, std::size_t alignment) {
  if (allocations_left == 0) {
    allocation_failed = true;
    throw std::bad_alloc();
  }
  if (allocations_left > 0) --allocations_left;
  // aligned_alloc wants a multiple of the alignment.
  const std::size_t whole = (size + alignment - 1) / alignment * alignment + (size == 0 ? alignment : 0);
  void* p = std::aligned_alloc(alignment, whole);
  if (p == nullptr) throw std::bad_alloc();
  return p;
}

}  // namespace halfspace::test

// Inlined, g++ 12 takes them for a mismatch of new and free.
#define REPLACEMENT __attribute__((noinline))
REPLACEMENT void* operator new(std::size_t size) {
  return halfspace::test::allocate(size, alignof(std::max_align_t));
}
REPLACEMENT void* operator new[](std::size_t size) {
  return halfspace::test::allocate(size, alignof(std::max_align_t));
}
REPLACEMENT void* operator new(std::size_t size, std::align_val_t a) {
  return halfspace::test::allocate(size, std::size_t(a));
}
REPLACEMENT void* operator new[](std::size_t size, std::align_val_t a) {
  return halfspace::test::allocate(size, std::size_t(a));
}
// The standard's own are not sure to end in those above: a sanitizer brings some of its own.
REPLACEMENT void* operator new(std::size_t size, const std::nothrow_t&) noexcept try {
  return halfspace::test::allocate(size, alignof(std::max_align_t));
} catch (const std::bad_alloc&) {
  return nullptr;
}
REPLACEMENT void* operator new[](std::size_t size, const std::nothrow_t&) noexcept try {
  return halfspace::test::allocate(size, alignof(std::max_align_t));
} catch (const std::bad_alloc&) {
  return nullptr;
}
REPLACEMENT void operator delete(void* p, const std::nothrow_t&) noexcept { std::free(p); }
REPLACEMENT void operator delete[](void* p, const std::nothrow_t&) noexcept { std::free(p); }
REPLACEMENT void operator delete(void* p) noexcept { std::free(p); }
REPLACEMENT void operator delete[](void* p) noexcept { std::free(p); }
REPLACEMENT void operator delete(void* p, std::size_t) noexcept { std::free(p); }
REPLACEMENT void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
REPLACEMENT void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
REPLACEMENT void operator delete[](void* p, std::align_val_t) noexcept { std::free(p); }
REPLACEMENT void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
REPLACEMENT void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
#undef REPLACEMENT
