#pragma once

#include "ref_app/backend.h"
#include "ref_app/options.h"

namespace ref_app {

// Draws the scenes asked for, times them, saves the pictures. Returns the program's exit code.
int run_scenes(Backend& backend, const Options& options);

}  // namespace ref_app
