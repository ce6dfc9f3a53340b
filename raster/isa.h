// Instruction sets: one place that chooses, and the names the per-ISA sources are compiled under.
//
// A source with SIMD in it is compiled once a level by Highway's foreach_target.h. raster/isa.cpp says which
// level's function to take:
//   HWY_ONCE part:  ShadeFunction select_shade() { HALFSPACE_SELECT_FUNCTION(ShadeVertices) }
#pragma once

namespace halfspace::raster {

enum class Isa : unsigned char { scalar, sse4, avx2, avx512, neon };

// The level in use. Reads an atomic; cheap, but take it once a draw, not once a pixel.
Isa current_isa();

}  // namespace halfspace::raster

// The body of a function after the HWY_ONCE guard: returns N_<level>::EXPRESSION for the level in use, say the value
// of a call (`ShadeVertices()`) or, with HALFSPACE_SELECT_FUNCTION, the address of a function.
#if defined(__x86_64__)
#define HALFSPACE_SELECT_LEVEL(PREFIX, EXPRESSION) \
  switch (::halfspace::raster::current_isa()) {    \
    case ::halfspace::raster::Isa::avx512:         \
      return PREFIX N_AVX3::EXPRESSION;            \
    case ::halfspace::raster::Isa::avx2:           \
      return PREFIX N_AVX2::EXPRESSION;            \
    case ::halfspace::raster::Isa::sse4:           \
      return PREFIX N_SSE4::EXPRESSION;            \
    default:                                       \
      return PREFIX N_SCALAR::EXPRESSION;          \
  }
#elif defined(__aarch64__)
#define HALFSPACE_SELECT_LEVEL(PREFIX, EXPRESSION) return PREFIX N_NEON::EXPRESSION;
#else
#define HALFSPACE_SELECT_LEVEL(PREFIX, EXPRESSION) return PREFIX N_SCALAR::EXPRESSION;
#endif
#define HALFSPACE_SELECT(NAME) HALFSPACE_SELECT_LEVEL(, NAME())
#define HALFSPACE_SELECT_FUNCTION(NAME) HALFSPACE_SELECT_LEVEL(&, NAME)
