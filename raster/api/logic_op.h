// Logical operation on colours (spec 4.1.10). It takes the place of blending.
#pragma once

#include "raster/api/types.h"

namespace halfspace::raster {

// In GL's order: GL_CLEAR .. GL_SET.
enum class LogicOp : uint8_t {
  clear,
  and_,
  and_reverse,
  copy,
  and_inverted,
  noop,
  xor_,
  or_,
  nor,
  equiv,
  invert,
  or_reverse,
  copy_inverted,
  or_inverted,
  nand,
  set,
};

struct LogicOpState {
  bool enabled = false;
  LogicOp op = LogicOp::copy;
  bool operator==(const LogicOpState&) const = default;
};

}  // namespace halfspace::raster
