// What the machine is called in reports.
#pragma once

#include <string>

namespace halfspace::compare {

// "model name" of the first processor, as /proc/cpuinfo has it.
std::string processor_name();

}  // namespace halfspace::compare
