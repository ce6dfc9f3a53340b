// Memory for one object after another of the same size: what is given back is handed out again, while it is
// still in the cache. For objects as large as a draw's state a general allocator takes as long as to derive
// it.
#pragma once

#include <cstddef>
#include <new>
#include <utility>

namespace halfspace::state {

// For one thread at a time. Blocks may outlive the pool.
class BlockPool {
 public:
  BlockPool() : shelf_(new Shelf) {}
  ~BlockPool() { shelf_->close(); }
  BlockPool(const BlockPool&) = delete;
  BlockPool& operator=(const BlockPool&) = delete;

  size_t kept() const { return shelf_->kept; }

  template <class T>
  class Allocator;

 private:
  struct Block {
    Block* next;
  };
  // Blocks of the first size that was asked for.
  struct Shelf {
    static constexpr size_t kMostKept = 512;
    Block* first = nullptr;
    size_t kept = 0, out = 0, block_bytes = 0;
    bool closed = false;

    void* take(size_t bytes) {
      if (block_bytes == 0) block_bytes = bytes;
      void* block = first;
      if (block != nullptr && bytes == block_bytes) {
        first = first->next;
        --kept;
      } else {
        block = ::operator new(bytes);
      }
      ++out;
      return block;
    }
    void put_back(void* memory, size_t bytes) {
      --out;
      if (bytes == block_bytes && kept < kMostKept && !closed) {
        first = new (memory) Block{first};
        ++kept;
      } else {
        ::operator delete(memory);
      }
      if (closed && out == 0) delete this;
    }
    void close() {
      while (first != nullptr) ::operator delete(std::exchange(first, first->next));
      closed = true;
      if (out == 0) delete this;
    }
  };
  Shelf* shelf_;
};

// For std::allocate_shared.
template <class T>
class BlockPool::Allocator {
 public:
  using value_type = T;
  explicit Allocator(const BlockPool& pool) : shelf_(pool.shelf_) {}
  template <class U>
  Allocator(const Allocator<U>& other) : shelf_(other.shelf_) {}
  T* allocate(size_t count) { return static_cast<T*>(shelf_->take(count * sizeof(T))); }
  void deallocate(T* objects, size_t count) { shelf_->put_back(objects, count * sizeof(T)); }
  template <class U>
  bool operator==(const Allocator<U>& other) const {
    return shelf_ == other.shelf_;
  }

 private:
  template <class U>
  friend class Allocator;
  Shelf* shelf_;
};

}  // namespace halfspace::state
