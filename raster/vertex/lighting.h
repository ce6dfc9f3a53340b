// From the draw state to what the lighting kernel takes.
#pragma once

#include <cstddef>
#include <span>

#include "raster/api/draw_packet.h"
#include "raster/vertex/lighting_job.h"

namespace halfspace::raster {

// materials: DrawPacket::materials, if the batch has a material_index; else empty.
LightingJob make_lighting_job(const LightingState& state, std::span<const MaterialPair> materials);

// x ^ s for x >= 0 and s in [0, 128], as the lighting kernel computes it: relative error at most 1e-5, 0
// where the result is below 2^-125, 2^64 where it is above that; 0 ^ 0 = 1. On the instruction set in use. Draft: at most
// 1e-3. Exact: the float nearest to what is right to 1e-12.
void power(const float* x, const float* s, float* out, size_t count, Level level = Level::standard);

}  // namespace halfspace::raster
