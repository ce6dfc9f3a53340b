// A corner of a primitive on its way from the vertex stage to the window, with all that is interpolated.
#pragma once

#include <array>

#include "raster/api/draw_state.h"
#include "tests/oracle/number.h"

namespace halfspace::oracle {

// Places in Corner::value. Colours are in [0, 1]; s t r q have been through the texture matrix; fog is |z_e|.
enum ValuePlace : size_t {
  kRed,
  kGreen,
  kBlue,
  kAlpha,
  kCoordS,
  kCoordT,
  kCoordR,
  kCoordQ,
  kFogDistance,
  kValues
};

struct Corner {
  Wide x = 0, y = 0, z = 0, w = 1;                  // clip coordinates
  std::array<Wide, raster::kMaxClipPlanes> user{};  // distances from the user clip planes
  std::array<Wide, kValues> value{};
  bool edge = true;  // of a polygon: the edge that starts here is drawn as a line (spec 2.6.2)
};

}  // namespace halfspace::oracle
