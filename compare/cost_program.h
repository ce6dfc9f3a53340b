// `halfspace cost -- PROGRAM`: a program's own frame under each setting.
#pragma once

#include "compare/cost.h"

namespace halfspace::compare {

// Adds one scene to `result`. The program is run to its end, once a setting and round: its time is the whole
// process's. It has to draw the same frames each time. OSMesa is timed only, since it leaves no frames.
// Throws StartError, NotFound, ImageError and std::runtime_error.
void measure_program(const CostOptions& options, const Progress& progress, CostResult& result);

}  // namespace halfspace::compare
