// Instruction sets: one place that chooses, and the names the per-ISA sources are compiled under.
//
// A source with SIMD in it is compiled once a level by Highway's foreach_target.h. It exports one function table a
// level; raster/isa.cpp's level says which to take:
//   HWY_ONCE part:  const VertexKernels& vertex_kernels() { HALFSPACE_SELECT(kernels) }
#pragma once

namespace halfspace::raster {

enum class Isa : unsigned char { scalar, sse4, avx2, avx512, neon };

// The level in use. Reads an atomic; cheap, but take it once a draw, not once a pixel.
Isa current_isa();

}  // namespace halfspace::raster

// In a function after the HWY_ONCE guard: returns N_<level>::NAME() for the level in use.
#if defined(__x86_64__)
#define HALFSPACE_SELECT(NAME)                    \
  switch (::halfspace::raster::current_isa()) {   \
    case ::halfspace::raster::Isa::avx512:        \
      return N_AVX3::NAME();                      \
    case ::halfspace::raster::Isa::avx2:          \
      return N_AVX2::NAME();                      \
    case ::halfspace::raster::Isa::sse4:          \
      return N_SSE4::NAME();                      \
    default:                                      \
      return N_SCALAR::NAME();                    \
  }
#elif defined(__aarch64__)
#define HALFSPACE_SELECT(NAME)                    \
  switch (::halfspace::raster::current_isa()) {   \
    case ::halfspace::raster::Isa::neon:          \
      return N_NEON::NAME();                      \
    default:                                      \
      return N_SCALAR::NAME();                    \
  }
#else
#define HALFSPACE_SELECT(NAME) return N_SCALAR::NAME();
#endif
