#include "bench/memory.h"

#include <fstream>
#include <string>

namespace halfspace::bench {

Memory memory_now() {
  Memory memory;
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;) {
    if (word == "VmRSS:") file >> memory.resident_kib;
    if (word == "VmHWM:") file >> memory.peak_kib;
  }
  return memory;
}

void forget_peak() {
  // Linux, proc(5): 5 resets VmHWM.
  std::ofstream("/proc/self/clear_refs") << 5 << std::endl;
}

}  // namespace halfspace::bench
