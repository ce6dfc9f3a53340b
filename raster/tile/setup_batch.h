// Eight primitives of one draw, set up for one tile: edges to walk and planes to evaluate. Structure of arrays; a
// primitive is (batch, lane).
#pragma once

#include <cstdint>

#include "raster/api/types.h"
#include "raster/primitive/segment.h"

namespace halfspace::raster {

inline constexpr int kSetupLanes = 8;

// Which of a program's variants a primitive takes. Decided by the primitive alone (NUMERICS.md).
enum Variant : uint8_t { kAffine = 1, kDouble = 2, kVariantCount = 4 };

struct alignas(64) SetupBatch {
  // Edge functions at the centre of the tile's lowest-left pixel, shifted right by the sub-pixel bits, with the fill
  // rule's bias in: a pixel is inside if all three are >= 0. Steps are per pixel.
  alignas(64) int32_t edge[3][kSetupLanes], step_x[3][kSetupLanes], step_y[3][kSetupLanes];
  // Pixels to look at, relative to the tile, inclusive; max < min when there are none.
  alignas(64) int32_t min_x[kSetupLanes], min_y[kSetupLanes], max_x[kSetupLanes], max_y[kSetupLanes];
  alignas(64) int32_t size[kSetupLanes];  // the larger side of a triangle's box, 16.8
  // Centre of the tile's lowest-left pixel minus the anchor vertex, in pixels: exact also as floats.
  alignas(64) double anchor_x[kSetupLanes], anchor_y[kSetupLanes];
  alignas(32) float anchor_x_f[kSetupLanes], anchor_y_f[kSetupLanes];
  // Planes: [0] depth in units of 2^-24 plus one half, [1] 1/w, [2 + i] attribute i (divided by w unless affine;
  // colours in 0..255).
  alignas(64) double f0[kMaxPlanes][kSetupLanes], dfdx[kMaxPlanes][kSetupLanes], dfdy[kMaxPlanes][kSetupLanes];
  alignas(64) float f0_f[kMaxPlanes][kSetupLanes], dfdx_f[kMaxPlanes][kSetupLanes], dfdy_f[kMaxPlanes][kSetupLanes];
  alignas(64) float flat[4][kSetupLanes];  // colour of the provoking vertex, 0..255
  uint8_t variant[kSetupLanes];
  // Where accuracy calls for them: the flat colour unrounded; one lambda for the primitive.
  double exact_flat[4][kSetupLanes];
  float lambda[kSetupLanes];
};

// 255 * c for a colour that is not interpolated, c in [0, 1]. `to_bytes`: the nearest float that rounds to the same byte
// as the exact product. 0.7f is below 178.5 / 255, but 0.7f * 255.0f is 178.5f.
inline float color_level(float c, bool to_bytes) {
  const double exact = static_cast<double>(c) * 255.0;
  const float level = static_cast<float>(exact);
  const auto byte = static_cast<int>(exact + 0.5);
  if (!to_bytes || static_cast<int>(level + 0.5f) == byte) return level;
  return static_cast<float>(byte) + 0.49f;  // only ever rounded up onto the tie
}

}  // namespace halfspace::raster
