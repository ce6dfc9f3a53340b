#include "gl/unimplemented.h"

#include <cstdio>
#include <cstring>

#include "state/context.h"
#include "state/error.h"

namespace halfspace::gl {

void call_of_unimplemented(const char* name, bool report) {
  if (report) std::fprintf(stderr, "halfspace: %s is not implemented yet\n", name);
  const bool window_system_call = std::strncmp(name, "glX", 3) == 0;
  state::Context* context = state::current_binding.context;
  if (context && !window_system_call) state::record_error(*context, GL_INVALID_OPERATION, name);
}

}  // namespace halfspace::gl
