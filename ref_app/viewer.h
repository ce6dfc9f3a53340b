#pragma once

#include "ref_app/backend.h"
#include "ref_app/options.h"

namespace ref_app {

// Shows the scenes in the backend's window until the user closes it. Returns the program's exit code.
int run_viewer(Backend& backend, const Options& options);

}  // namespace ref_app
