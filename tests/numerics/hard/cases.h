// The functions of cases.def.
#pragma once

#include "stage.h"

namespace halfspace::hard {

#define HARD_CASE(function, level, hazard, claim) void function(Stage& stage);
#include "cases.def"
#undef HARD_CASE

}  // namespace halfspace::hard
