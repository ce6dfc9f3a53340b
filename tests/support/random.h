// Random numbers that are the same under every standard library.
#pragma once

#include <cstdint>

namespace halfspace::test {

// splitmix64.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  uint64_t bits() {
    uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  // low .. high, both included.
  int64_t integer(int64_t low, int64_t high) { return low + int64_t(bits() % uint64_t(high - low + 1)); }
  // [low, high), in steps of 2^-24 of the range.
  float real(float low, float high) { return low + (high - low) * (float(bits() >> 40) / 16777216.0f); }

 private:
  uint64_t state_;
};

}  // namespace halfspace::test
