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

  // Where one of the last vertices with this position's hash stands, if there is one. An old batch's number
  // is too large, or stands for a vertex that will be seen to differ.
  struct Place {
    uint16_t& slot;
    bool exists;
  };
  Place look(Quad position) {
    uint16_t& slot = slots_[hash(position)];
    return {slot, distinct_ - 1 - slot < reach_};
  }
  // The vertex that was looked for is the one that stands there.
  void add_again(Place place) {
    indices_[given_++] = place.slot;
    repeats_ = true;
  }
  // It is to stand behind all others.
  void add_new(Place place) {
    indices_[given_++] = distinct_;
    place.slot = static_cast<uint16_t>(distinct_++);
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
