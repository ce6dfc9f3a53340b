// Objects that are made again and again: their memory is kept, and they stay where they are.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace halfspace::raster {

// A list that grows at its end and is emptied all at once. An object gives way to a fresh one when the list is
// emptied, so that it holds on to nothing meanwhile; where it stands, since to move one there takes longer.
template <class T>
class Recycled {
 public:
  T& emplace_back() {
    if (size_ == all_.size()) all_.push_back(std::make_unique<T>());
    return *all_[size_++];
  }
  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](size_t i) const { return *all_[i]; }
  T& back() const { return *all_[size_ - 1]; }
  void clear() {
    static_assert(std::is_nothrow_default_constructible_v<T>);
    while (size_ > 0) {
      T* object = all_[--size_].get();
      std::destroy_at(object);
      std::construct_at(object);
    }
  }

 private:
  std::vector<std::unique_ptr<T>> all_;
  size_t size_ = 0;
};

}  // namespace halfspace::raster
