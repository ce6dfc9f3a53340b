#include "compare/chart_axis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace halfspace::compare {
namespace {

constexpr double kZeroStep = 26;  // from the zero's place to where the logarithm begins

}  // namespace

LogAxis::LogAxis(double lowest, double highest, double from, double to, bool with_zero)
    : lowest_(lowest), highest_(highest), from_(from), to_(to), zero_place_(from) {
  if (with_zero) from_ += to > from ? kZeroStep : -kZeroStep;
}

double LogAxis::place(double value) const {
  if (!(value >= lowest_)) return value <= 0 || zero_place_ != from_ ? zero_place_ : from_;
  const double share = std::log(std::min(value, highest_) / lowest_) / std::log(highest_ / lowest_);
  return std::lerp(from_, to_, share);
}

std::vector<Tick> LogAxis::ticks(double base, const char* unit) const {
  std::vector<Tick> ticks;
  for (double power = std::ceil(std::log(lowest_) / std::log(base) - 1e-9);
       std::pow(base, power) <= highest_ * (1 + 1e-9); ++power) {
    const double value = std::pow(base, power);
    ticks.push_back({value, tick_label(value) + unit});
  }
  return ticks;
}

std::string tick_label(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  if (value >= 1e6)
    std::snprintf(text, sizeof text, "%g M", value * 1e-6);
  else if (value >= 1e3 && std::fmod(value, 1e3) == 0)
    std::snprintf(text, sizeof text, "%g,000", value * 1e-3);
  if (value != 0 && std::abs(value) < 1e-4) std::snprintf(text, sizeof text, "%.0e", value);
  return text;
}

}  // namespace halfspace::compare
