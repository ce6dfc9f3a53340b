#include "compare/statistics.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace halfspace::compare {

double quantile(const std::vector<double>& sorted, double q) {
  const double position = q * static_cast<double>(sorted.size() - 1);
  const size_t below = static_cast<size_t>(std::floor(position));
  const size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], position - static_cast<double>(below));
}

Summary summarize(std::vector<double> values) {
  Summary summary;
  if (values.empty()) return summary;
  std::sort(values.begin(), values.end());
  summary.median = quantile(values, 0.5);
  summary.lowest = values.front();
  summary.highest = values.back();
  summary.count = static_cast<int>(values.size());
  if (summary.median != 0)
    summary.spread = (quantile(values, 0.75) - quantile(values, 0.25)) / 2 / summary.median;
  return summary;
}

Summary paired_ratio(const std::vector<double>& values, const std::vector<double>& divisors) {
  std::vector<double> ratios;
  for (size_t i = 0; i < std::min(values.size(), divisors.size()); ++i)
    if (divisors[i] > 0) ratios.push_back(values[i] / divisors[i]);
  return summarize(std::move(ratios));
}

}  // namespace halfspace::compare
