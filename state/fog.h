// Fog (spec 3.10).
#pragma once

#include "raster/api/fog.h"
#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

struct FogState {
  bool enabled = false;
  GLenum mode = GL_EXP;
  raster::Color color;  // in [0, 1]
  float density = 1, start = 0, end = 1;
  float index = 0;  // of colour-index buffers; kept for the queries
};

raster::FogState derive_fog(const Context& context);

}  // namespace halfspace::state
