// The accuracy a context starts with.
#pragma once

#include <optional>
#include <string_view>

#include "raster/api/accuracy.h"

namespace halfspace::state {

// LEVEL[,AXIS=LEVEL]... or AXIS=LEVEL[,AXIS=LEVEL]...: the level without an axis is for all that are not
// named, and comes first; without one they are standard. Null: it says something else.
std::optional<raster::Accuracy> parse_accuracy(std::string_view text);

// HALFSPACE_ACCURACY; standard, with a message, when that cannot be read.
raster::Accuracy accuracy_from_environment();

}  // namespace halfspace::state
