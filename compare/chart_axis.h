// Axes of our charts: from a value to a place, and the ticks.
#pragma once

#include <string>
#include <vector>

#include "compare/svg.h"

namespace halfspace::compare {

struct Tick {
  double value = 0;
  std::string label;
};

// A logarithmic axis from `lowest` to `highest`, laid between two places. With a zero, values below `lowest`
// have a place of their own, a step before it.
class LogAxis {
 public:
  LogAxis(double lowest, double highest, double from, double to, bool with_zero);

  double place(double value) const;
  double zero_place() const { return zero_place_; }
  // Powers of `base` within the axis.
  std::vector<Tick> ticks(double base, const char* unit) const;

 private:
  double lowest_, highest_, from_, to_, zero_place_;
};

// "0.25", "1", "10,000", "2 M": no more digits than are needed.
std::string tick_label(double value);

}  // namespace halfspace::compare
