// Stencil test (spec 4.1.5). Eight bits.
#pragma once

#include "raster/api/types.h"

namespace halfspace::raster {

enum class StencilOp : uint8_t { keep, zero, replace, increment, decrement, invert };

// Without a stencil test (`test` false) nothing else here matters. A framebuffer gets its stencil plane when the
// first draw or clear asks for it.
struct StencilState {
  bool test = false;
  CompareFunc func = CompareFunc::always;
  uint8_t reference = 0, compare_mask = 0xff, write_mask = 0xff;
  StencilOp fail = StencilOp::keep, depth_fail = StencilOp::keep, depth_pass = StencilOp::keep;
  bool operator==(const StencilState&) const = default;
};

}  // namespace halfspace::raster
