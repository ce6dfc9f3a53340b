// Lighting and texture coordinate generation at one vertex, straight from the formulas of spec 2.14.1
// and 2.11.4.
#pragma once

#include <array>

#include "raster/api/draw_state.h"

namespace halfspace::oracle {

using Real3 = std::array<long double, 3>;
using Real4 = std::array<long double, 4>;

struct LitVertex {
  Real4 front, back;  // clamped to [0, 1]
  // How near a light is to where its part jumps by something that can be seen: the least |n . VP| and
  // |cosine - cutoff's cosine|.
  long double margin;
};

// V and n as they come from the application, through the state's matrices.
Real4 eye_position(const raster::DrawState& state, const Real4& position);
Real3 eye_normal(const raster::DrawState& state, const Real3& normal);

// The materials are what color material has left.
LitVertex light_vertex(const raster::DrawState& state, const raster::MaterialPair& materials,
                       const Real4& position, const Real3& normal);

// s t r q; the texture matrix has no part in it.
Real4 generate(const raster::DrawState& state, const Real4& position, const Real3& normal,
               const Real4& given);

}  // namespace halfspace::oracle
