// Vertices that a batch between Begin and End gives again are kept, and later shaded, once: a mesh gives each
// of its vertices some six times.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "state/quad.h"

namespace halfspace::state {

// Numbers the vertices of a batch. One that lately came is found again by its position's hash; one that is
// not found is kept twice, which costs time but changes nothing.
class SharedVertices {
 public:
  // Begins a batch; `possible`: of a kind that can have indices. Where too little was found lately, nothing
  // is looked for.
  void start(bool possible) {
    active_ = possible && pause_ == 0;
    given_ = distinct_ = 0;
    repeats_ = false;
    reach_ = kReach;
  }
  // From here on every vertex is a new one.
  void find_no_more() { reach_ = 0; }

  bool active() const { return active_; }
  uint32_t given() const { return given_; }
  uint32_t distinct() const { return distinct_; }
  // Null where the vertices are given in turn.
  const uint32_t* indices() const { return repeats_ ? indices_.data() : nullptr; }

  // Room for so many; may throw std::bad_alloc.
  void reserve(size_t count) {
    if (indices_.size() < count) indices_.resize(count);
  }

  // Adds the vertex at `v`, which is behind the `distinct()` others that begin at `first`; true if it is to
  // stay there. Vertices have `floats` numbers, 8, 12 or 16, of which the first four are `position`, and are
  // compared bit by bit.
  bool add(Quad position, const float* v, const float* first, uint32_t floats) {
    uint16_t& slot = slots_[hash(position)];
    const uint32_t found = slot;
    // An old batch's number is too large, or stands for a vertex that will be seen to differ.
    if (distinct_ - 1 - found < reach_ && same(position, v, first + size_t{found} * floats, floats)) {
      indices_[given_++] = found;
      repeats_ = true;
      return false;
    }
    indices_[given_++] = distinct_;
    slot = static_cast<uint16_t>(distinct_++);
    return true;
  }

  // Drops the last ones.
  void truncate(uint32_t count) {
    repeats_ |= count != given_;
    given_ = count;
  }

  // The batch of `count` vertices was drawn.
  void note_drawn(uint32_t count) {
    if (!active_) {
      pause_ -= pause_ < count ? pause_ : count;
      return;
    }
    tried_ += given_;
    kept_ += distinct_;
    if (tried_ < kTrial) return;
    if (kept_ > tried_ - tried_ / 4) pause_ = kPause;
    tried_ = kept_ = 0;
  }

 private:
  static constexpr unsigned kSlotBits = 14;
  // How far back a vertex is found: some rows of a mesh. Draws are taken in parts, each with all vertices
  // from the lowest index to the highest.
  static constexpr uint32_t kReach = 1u << 12;
  // Of so many vertices at least a quarter has to be found, or else so many are taken as they come.
  static constexpr uint32_t kTrial = 1024, kPause = 16 * kTrial;

  using Bits [[gnu::vector_size(16)]] = uint64_t;
  static Bits difference(Quad a, Quad b) { return reinterpret_cast<Bits>(a) ^ reinterpret_cast<Bits>(b); }
  static bool same(Quad position, const float* v, const float* other, uint32_t floats) {
    Bits differs =
        difference(position, load_quad(other)) | difference(load_quad(v + 4), load_quad(other + 4));
    if (floats > 8) differs |= difference(load_quad(v + 8), load_quad(other + 8));
    if (floats > 12) differs |= difference(load_quad(v + 12), load_quad(other + 12));
    return (differs[0] | differs[1]) == 0;
  }
  static size_t hash(Quad position) {
    const auto word = [&](int i) { return std::bit_cast<uint32_t>(position[i]); };
    return (word(0) * 0x9e3779b1u + word(1) * 0x85ebca77u + word(2) * 0xc2b2ae3du) >> (32 - kSlotBits);
  }

  bool active_ = false, repeats_ = false;
  uint32_t given_ = 0, distinct_ = 0, reach_ = 0;
  uint32_t tried_ = 0, kept_ = 0, pause_ = 0;
  std::vector<uint32_t> indices_;
  std::array<uint16_t, size_t{1} << kSlotBits> slots_{};  // the latest vertex of each hash
};

}  // namespace halfspace::state
