// Objects that are made again and again: their memory is kept, and they stay where they are.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace halfspace::raster {

// A list that grows at its end and is emptied all at once. An object is assigned a fresh one when the list is
// emptied, so that it holds on to nothing meanwhile.
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
    while (size_ > 0) *all_[--size_] = T();
  }

 private:
  std::vector<std::unique_ptr<T>> all_;
  size_t size_ = 0;
};

}  // namespace halfspace::raster
