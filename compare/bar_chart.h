// Horizontal bars as SVG.
#pragma once

#include <string>
#include <vector>

namespace halfspace::compare {

struct Bar {
  std::string label;
  double value = 0;   // in units of the chart
  double target = 0;  // a mark across the bar; none at 0
  bool good = true;   // chooses the colour
};

struct BarChart {
  std::string title;
  std::string unit;      // behind each value
  double reference = 1;  // a dashed line over all bars, with `reference_label`
  std::string reference_label;
  std::vector<Bar> bars;
};

// A whole <svg> element.
std::string to_svg(const BarChart& chart);

}  // namespace halfspace::compare
