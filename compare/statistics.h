// Medians and spreads of repeated measurements.
#pragma once

#include <vector>

namespace halfspace::compare {

struct Summary {
  double median = 0;
  double lowest = 0;
  double highest = 0;
  // Half the distance between the quartiles, as a share of the median: how far the middle half of the runs
  // lies from it. 0.03 reads "+- 3 %".
  double spread = 0;
  int count = 0;
};

// All zero for no values.
Summary summarize(std::vector<double> values);

// Of what was measured in turns: each value over the one it took turns with. A machine that is faster now and
// slower a moment later changes both of a pair, but may have either list's median fall where the other's does
// not. Values without a partner, and pairs whose divisor is not above 0, are left out.
Summary paired_ratio(const std::vector<double>& values, const std::vector<double>& divisors);

// Quantile q in [0, 1], linear between neighbours; `sorted` is ascending and not empty.
double quantile(const std::vector<double>& sorted, double q);

}  // namespace halfspace::compare
