// Objects that are made over and over, each a little different from one that was made before.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "state/derive/block_pool.h"

namespace halfspace::state {

// Hands out objects of T; one that nobody refers to any more comes back, and is handed out again as it was, but for
// what its retire() lets go of. The latest first, since it is still in the cache. For one thread at a time. Objects may
// outlive it.
template <class T>
class Reused {
 public:
  Reused() : store_(new Store) {}
  ~Reused() { store_->close(); }
  Reused(const Reused&) = delete;
  Reused& operator=(const Reused&) = delete;

  size_t kept() const { return store_->idle.size(); }

  // May throw std::bad_alloc.
  std::shared_ptr<T> take() {
    std::unique_ptr<T> object = store_->take();
    const BlockPool::Allocator<T> counts(counts_);
    return std::shared_ptr<T>(object.release(), PutBack{store_}, counts);
  }

 private:
  struct Store {
    static constexpr size_t kMostKept = 512;
    std::vector<std::unique_ptr<T>> idle;
    size_t out = 0;
    bool closed = false;

    std::unique_ptr<T> take() {
      std::unique_ptr<T> object;
      if (idle.empty()) {
        if (idle.capacity() == 0) idle.reserve(kMostKept);  // what comes back must not ask for memory
        object = std::make_unique<T>();
      } else {
        object = std::move(idle.back());
        idle.pop_back();
      }
      ++out;
      return object;
    }
    void put_back(std::unique_ptr<T> object) {
      --out;
      if (idle.size() < idle.capacity() && !closed) {
        object->retire();
        idle.push_back(std::move(object));
      }
      if (closed && out == 0) delete this;
    }
    void close() {
      idle.clear();
      closed = true;
      if (out == 0) delete this;
    }
  };
  struct PutBack {
    Store* store;
    void operator()(T* object) const { store->put_back(std::unique_ptr<T>(object)); }
  };

  BlockPool counts_;  // of the references
  Store* store_;
};

}  // namespace halfspace::state
