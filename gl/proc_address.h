// GetProcAddress, without the names a front end adds.
#pragma once

#include <cstddef>

namespace halfspace::gl {

using Proc = void (*)();

struct ProcEntry {
  const char* name;
  Proc proc;
};

// The implemented commands, sorted by name (gl/proc_table.gen.cpp).
extern const ProcEntry kProcTable[];
extern const size_t kProcCount;

// The address of a GL command; null for a name that is not implemented, also when it is exported, so that a
// program which asks can do without.
Proc get_proc_address(const char* name);

}  // namespace halfspace::gl
