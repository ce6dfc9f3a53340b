#include "gl/proc_address.h"

#include <cstring>

namespace halfspace::gl {

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
  return nullptr;
}

}  // namespace halfspace::gl
