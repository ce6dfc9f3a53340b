// Where std::bad_alloc stops: it becomes GL_OUT_OF_MEMORY (spec 2.5).
#pragma once

#include <new>

#include "state/error.h"

namespace halfspace::state {

// Runs `work`. It must leave the state as it was when it throws.
template <class Work>
void guard_memory(Context& context, Work&& work, const char* operation = __builtin_FUNCTION()) {
  try {
    work();
  } catch (const std::bad_alloc&) {
    record_error(context, GL_OUT_OF_MEMORY, operation);
  }
}

}  // namespace halfspace::state
