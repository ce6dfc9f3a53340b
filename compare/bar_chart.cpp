#include "compare/bar_chart.h"

#include <algorithm>

#include "compare/formatted.h"
#include "compare/svg.h"

namespace halfspace::compare {
namespace {

constexpr double kLabelWidth = 206, kPlotWidth = 480, kValueWidth = 94;
constexpr double kBarHeight = 18, kBarStep = 26, kTop = 84;

double largest(const BarChart& chart) {
  double value = std::max(chart.reference, 1e-9);
  for (const Bar& bar : chart.bars) value = std::max({value, bar.value, bar.target});
  return value;
}

bool has_targets(const BarChart& chart) {
  return std::any_of(chart.bars.begin(), chart.bars.end(), [](const Bar& bar) { return bar.target > 0; });
}

void draw(Svg& svg, const Bar& bar, double y, double scale, const std::string& unit) {
  const double length = bar.value * scale, words = y + kBarHeight - 5;
  svg.text(kLabelWidth - 10, words, bar.label, {"end", ink::kText, 13});
  svg.rect(kLabelWidth, y, length, kBarHeight, bar.good ? ink::kOurs : ink::kOursPale);
  const double mark = bar.target * scale;
  if (bar.target > 0)
    svg.line(kLabelWidth + mark, y - 3, kLabelWidth + mark, y + kBarHeight + 3, ink::kText, 2);
  // Not under the target's mark, when that stands just behind the bar.
  const double end = mark > length && mark < length + 50 ? mark : length;
  svg.text(kLabelWidth + end + 6, words, formatted("%.3g", bar.value) + unit, {"start", ink::kText, 13});
}

}  // namespace

std::string to_svg(const BarChart& chart) {
  const double scale = kPlotWidth / largest(chart);
  const double height = kTop + kBarStep * static_cast<double>(chart.bars.size()) + 12;
  Svg svg(kLabelWidth + kPlotWidth + kValueWidth, height);
  svg.text(16, 26, chart.title, {"start", ink::kText, 16, true});
  if (has_targets(chart)) svg.text(16, 46, "mark: the target; dark: reached", {"start", ink::kSoft, 12});
  if (chart.reference > 0) {
    const double x = kLabelWidth + chart.reference * scale;
    svg.line(x, kTop - 8, x, height - 8, ink::kTheirs, 1.5, "4 3");
    svg.text(x, kTop - 14, chart.reference_label, {"middle", ink::kTheirs, 12});
  }
  for (size_t i = 0; i < chart.bars.size(); ++i)
    draw(svg, chart.bars[i], kTop + kBarStep * static_cast<double>(i), scale, chart.unit);
  return svg.str();
}

}  // namespace halfspace::compare
