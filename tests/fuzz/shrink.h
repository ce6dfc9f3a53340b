// Cuts a failing stream down.
#pragma once

#include <functional>

#include "call.h"

namespace halfspace::fuzz {

// Delta debugging: leaves out ever smaller runs of calls as long as `fails` still says so. `fails` is asked
// about well-formed streams only, `most_tries` times at most. The result is well-formed and fails.
Stream shrink(const Stream& stream, const std::function<bool(const Stream&)>& fails, int most_tries);

}  // namespace halfspace::fuzz
