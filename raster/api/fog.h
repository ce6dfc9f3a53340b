// Fog (spec 3.10), computed at each fragment from the eye-space distance |z_e|.
#pragma once

#include "raster/api/types.h"

namespace halfspace::raster {

enum class FogMode : uint8_t { linear, exp, exp2 };

struct FogState {
  bool enabled = false;
  FogMode mode = FogMode::exp;
  Color color;  // in [0, 1]; alpha is not used
  float density = 1, start = 0, end = 1;
  bool operator==(const FogState&) const = default;
};

}  // namespace halfspace::raster
