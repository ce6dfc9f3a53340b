#include "compare/bar_chart.h"

#include <algorithm>
#include <cstdio>

#include "compare/difference_text.h"
#include "compare/html.h"

namespace halfspace::compare {
namespace {

constexpr double kLabelWidth = 190, kPlotWidth = 480, kValueWidth = 90;
constexpr double kBarHeight = 18, kBarStep = 28, kTop = 56;

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::string text_at(double x, double y, const char* anchor, const std::string& text) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\">" +
         escape_html(text) + "</text>\n";
}

std::string line(double x, double y0, double y1, const char* style) {
  return "<line x1=\"" + number(x) + "\" x2=\"" + number(x) + "\" y1=\"" + number(y0) + "\" y2=\"" +
         number(y1) + "\" " + style + "/>\n";
}

std::string bar_svg(const Bar& bar, double y, double scale, const std::string& unit) {
  const double length = bar.value * scale;
  std::string svg = text_at(kLabelWidth - 10, y + kBarHeight - 5, "end", bar.label);
  svg += "<rect x=\"" + number(kLabelWidth) + "\" y=\"" + number(y) + "\" width=\"" + number(length) +
         "\" height=\"" + number(kBarHeight) + "\" rx=\"2\" fill=\"" + (bar.good ? "#4c8bf5" : "#d9534f") +
         "\"/>\n";
  // Not under the target's mark, when that stands just behind the bar.
  const double mark = bar.target * scale;
  const double end = mark > length && mark < length + 50 ? mark : length;
  svg += text_at(kLabelWidth + end + 6, y + kBarHeight - 5, "start", short_number(bar.value) + unit);
  if (bar.target > 0)
    svg += line(kLabelWidth + bar.target * scale, y - 3, y + kBarHeight + 3,
                "stroke=\"#8a8f95\" stroke-width=\"2\"");
  return svg;
}

double largest(const BarChart& chart) {
  double value = std::max(chart.reference, 1e-9);
  for (const Bar& bar : chart.bars) value = std::max({value, bar.value, bar.target});
  return value;
}

}  // namespace

std::string to_svg(const BarChart& chart) {
  const double scale = kPlotWidth / largest(chart);
  const double height = kTop + kBarStep * static_cast<double>(chart.bars.size()) + 12;
  const double width = kLabelWidth + kPlotWidth + kValueWidth;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(width) + "\" height=\"" +
                    number(height) + "\" viewBox=\"0 0 " + number(width) + " " + number(height) +
                    "\" font-family=\"system-ui, sans-serif\" font-size=\"13\">\n"
                    // On its own the picture follows the reader's scheme; inside a page, the page's colour.
                    "<style>svg{color-scheme:light dark}text{fill:currentColor}</style>\n";
  svg += text_at(0, 18, "start", chart.title);
  for (size_t i = 0; i < chart.bars.size(); ++i)
    svg += bar_svg(chart.bars[i], kTop + kBarStep * static_cast<double>(i), scale, chart.unit);
  if (chart.reference > 0) {
    const double x = kLabelWidth + chart.reference * scale;
    svg += line(x, kTop - 8, height - 8, "stroke=\"#8a8f95\" stroke-dasharray=\"4 3\"");
    svg += text_at(x, kTop - 14, "end", chart.reference_label);
  }
  return svg + "</svg>\n";
}

}  // namespace halfspace::compare
