// Four floats in a register. What is stored in parts and read whole has to wait for the cache, and compilers
// take arrays apart: so a vertex's values move by fours, from the calls that set them to where vertices are
// gathered.
#pragma once

#include <cstdint>
#include <cstring>

namespace halfspace::state {

using Quad [[gnu::vector_size(16)]] = float;

inline Quad load_quad(const float* v) {
  Quad quad;
  std::memcpy(&quad, v, sizeof quad);
  return quad;
}
// Zero where all bits are the same: 0 and -0 differ.
using QuadBits [[gnu::vector_size(16)]] = uint64_t;
inline QuadBits difference(Quad a, const float* b) {
  return reinterpret_cast<QuadBits>(a) ^ reinterpret_cast<QuadBits>(load_quad(b));
}

inline void store_quad(Quad quad, float* v) { std::memcpy(v, &quad, sizeof quad); }

}  // namespace halfspace::state
