// Instruction sets: one place that chooses, and the names the per-ISA sources are compiled under.
//
// A source with SIMD in it is compiled once a level by Highway's foreach_target.h. raster/isa.cpp says which
// level's function to take:
//   HWY_ONCE part:  ShadeFunction select_shade() { HALFSPACE_SELECT_FUNCTION(ShadeVertices) }
// HALFSPACE_WITH_*: the levels of this build (CMake's HALFSPACE_LEVELS); the scalar one is always there.
#pragma once

namespace halfspace::raster {

enum class Isa : unsigned char { scalar, sse4, avx2, avx512, neon };

// The level in use. Reads an atomic; cheap, but take it once a draw, not once a pixel.
Isa current_isa();

}  // namespace halfspace::raster

// The body of a function after the HWY_ONCE guard: returns N_<level>::EXPRESSION for the level in use, say
// the value of a call (`ShadeVertices()`) or, with HALFSPACE_SELECT_FUNCTION, the address of a function.
#if defined(__x86_64__)
// Nothing for a level that the build leaves out: HALFSPACE_WITH_* is pasted as 0 or 1.
#define HALFSPACE_CASE_0(LEVEL, EXPRESSION)
#define HALFSPACE_CASE_1(LEVEL, EXPRESSION) \
  case ::halfspace::raster::Isa::LEVEL:     \
    return EXPRESSION;
#define HALFSPACE_CASE_IF(WITH, LEVEL, EXPRESSION) HALFSPACE_CASE_##WITH(LEVEL, EXPRESSION)
#define HALFSPACE_CASE(WITH, LEVEL, EXPRESSION) HALFSPACE_CASE_IF(WITH, LEVEL, EXPRESSION)
#define HALFSPACE_SELECT_LEVEL(PREFIX, EXPRESSION)                           \
  switch (::halfspace::raster::current_isa()) {                              \
    HALFSPACE_CASE(HALFSPACE_WITH_AVX512, avx512, PREFIX N_AVX3::EXPRESSION) \
    HALFSPACE_CASE(HALFSPACE_WITH_AVX2, avx2, PREFIX N_AVX2::EXPRESSION)     \
    HALFSPACE_CASE(HALFSPACE_WITH_SSE4, sse4, PREFIX N_SSE4::EXPRESSION)     \
    default:                                                                 \
      return PREFIX N_SCALAR::EXPRESSION;                                    \
  }
#elif defined(__aarch64__)
#define HALFSPACE_SELECT_LEVEL(PREFIX, EXPRESSION) return PREFIX N_NEON::EXPRESSION;
#else
#define HALFSPACE_SELECT_LEVEL(PREFIX, EXPRESSION) return PREFIX N_SCALAR::EXPRESSION;
#endif
#define HALFSPACE_SELECT(NAME) HALFSPACE_SELECT_LEVEL(, NAME())
#define HALFSPACE_SELECT_FUNCTION(NAME) HALFSPACE_SELECT_LEVEL(&, NAME)
