// This process's memory.
#pragma once

namespace halfspace::bench {

struct Memory {
  long resident_kib = 0;
  long peak_kib = 0;  // the most that was resident since the start or forget_peak()
};

Memory memory_now();

void forget_peak();

}  // namespace halfspace::bench
