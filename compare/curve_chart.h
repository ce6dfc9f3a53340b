// Curves over logarithmic axes as SVG.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace halfspace::compare {

struct Curve {
  std::string label;
  std::vector<std::pair<double, double>> points;  // what is not above 0 is left out
};

struct CurveChart {
  std::string title, x_label;
  std::string y_unit;  // behind the numbers of that axis
  std::vector<Curve> curves;
};

// Charts side by side in one whole <svg> element.
std::string to_svg(const std::vector<CurveChart>& charts);

}  // namespace halfspace::compare
