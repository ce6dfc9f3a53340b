// What happens when a program calls a name that is exported but not implemented.
#pragma once

namespace halfspace::gl {

// Records GL_INVALID_OPERATION in the calling thread's context, if it has one and `name` is a GL command;
// with `report`, says on stderr which name it was.
void call_of_unimplemented(const char* name, bool report);

}  // namespace halfspace::gl
