// Fog (spec 3.10).
#pragma once

#include "raster/api/fog.h"
#include "tests/oracle/number.h"

namespace halfspace::oracle {

// f of equations 3.28 to 3.30 (exp, exp2, linear), clamped; z >= 0 is the eye distance. The colour becomes
// f C + (1 - f) C_f.
inline Real fog_factor(const raster::FogState& fog, Real z) {
  switch (fog.mode) {
    case raster::FogMode::exp:
      return std::exp(-real(fog.density) * z);
    case raster::FogMode::exp2:
      return std::exp(-(real(fog.density) * z) * (real(fog.density) * z));
    case raster::FogMode::linear:
      break;
  }
  const Real span = real(fog.end) - real(fog.start);
  if (span == 0) return z < real(fog.end) ? 1 : 0;  // a wall
  return held((real(fog.end) - z) / span, 0.0L, 1.0L);
}

}  // namespace halfspace::oracle
