// One line on stderr, for what a program ought to hear about but GL has no error for.
#pragma once

namespace halfspace::state {

// printf-like; "halfspace: " before and a newline after it.
void report(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace halfspace::state
