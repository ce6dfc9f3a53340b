#include "gl/proc_address.h"

#include <cstring>

#include "gl/entry.h"
#include "state/hint.h"

namespace halfspace::gl {
namespace {

// Reached by its address only: it is no part of any ABI.
HALFSPACE_NO_NULL_CHECK void accuracy(GLenum axis, GLenum level) {
  if (state::Context* context = state::current_binding.context) state::set_accuracy(*context, axis, level);
}

}  // namespace

Proc get_proc_address(const char* name) {
  if (!name) return nullptr;
  size_t low = 0, high = kProcCount;
  while (low < high) {
    const size_t middle = low + (high - low) / 2;
    const int order = std::strcmp(name, kProcTable[middle].name);
    if (order == 0) return kProcTable[middle].proc;
    if (order < 0)
      high = middle;
    else
      low = middle + 1;
  }
  if (std::strcmp(name, "glAccuracyHALFSPACE") == 0) return reinterpret_cast<Proc>(accuracy);
  return nullptr;
}

}  // namespace halfspace::gl
