#include "compare/curve_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "compare/html.h"

namespace halfspace::compare {
namespace {

constexpr double kWidth = 400, kHeight = 270;
constexpr double kLeft = 62, kRight = 28, kTop = 50, kBottom = 46;
// Told apart by colour and by dashes.
constexpr std::array<const char*, 3> kStyles{"stroke=\"#4c8bf5\"",
                                             "stroke=\"#d9822b\" stroke-dasharray=\"5 3\"",
                                             "stroke=\"#3aa76d\" stroke-dasharray=\"2 3\""};
constexpr const char* kGrid = "stroke=\"#8a8f95\" stroke-opacity=\"0.35\"";

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

// 0.01, 1, 1,000, 10 M.
std::string tick_text(double value) {
  char text[40];
  if (value >= 1e6)
    std::snprintf(text, sizeof text, "%g M", value * 1e-6);
  else if (value >= 1e3)
    std::snprintf(text, sizeof text, "%g,000", value * 1e-3);
  else
    std::snprintf(text, sizeof text, "%g", value);
  return text;
}

// Whole powers of ten around what it is shown.
struct Axis {
  double low = 0, high = 1;  // exponents

  void take(double value, bool first) {
    const double exponent = std::log10(value);
    low = first ? std::floor(exponent) : std::min(low, std::floor(exponent));
    high = first ? std::ceil(exponent) : std::max(high, std::ceil(exponent));
    if (high <= low) high = low + 1;
  }
  double share(double value) const { return (std::log10(value) - low) / (high - low); }
};

std::string text_at(double x, double y, const char* anchor, const std::string& text) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\">" +
         escape_html(text) + "</text>\n";
}

std::string line(double x0, double y0, double x1, double y1, const std::string& style) {
  return "<line x1=\"" + number(x0) + "\" y1=\"" + number(y0) + "\" x2=\"" + number(x1) + "\" y2=\"" +
         number(y1) + "\" " + style + "/>\n";
}

class Plot {
 public:
  Plot(const CurveChart& chart, double left) : chart_(chart), left_(left + kLeft) {
    bool first = true;
    for (const Curve& curve : chart.curves)
      for (const auto& [x, y] : curve.points) {
        if (x <= 0 || y <= 0) continue;
        x_.take(x, first);
        y_.take(y, first);
        first = false;
      }
  }

  std::string svg() const {
    std::string svg = text_at(left_ - kLeft + 4, 18, "start", chart_.title) + grid();
    for (size_t i = 0; i < chart_.curves.size(); ++i)
      svg += curve(chart_.curves[i], kStyles[i % kStyles.size()], i);
    svg += text_at(left_, kHeight - 8, "start", chart_.x_label);
    return svg + text_at(left_ - kLeft + 4, kTop - 12, "start", chart_.y_label);
  }

 private:
  static constexpr double kPlotWidth = kWidth - kLeft - kRight, kPlotHeight = kHeight - kTop - kBottom;

  double x_at(double value) const { return left_ + kPlotWidth * x_.share(value); }
  double y_at(double value) const { return kTop + kPlotHeight * (1 - y_.share(value)); }

  std::string grid() const {
    std::string svg;
    for (double e = x_.low; e <= x_.high; ++e) {
      const double x = x_at(std::pow(10, e));
      svg += line(x, kTop, x, kTop + kPlotHeight, kGrid);
      svg += text_at(x, kTop + kPlotHeight + 16, "middle", tick_text(std::pow(10, e)));
    }
    for (double e = y_.low; e <= y_.high; ++e) {
      const double y = y_at(std::pow(10, e));
      svg += line(left_, y, left_ + kPlotWidth, y, kGrid);
      svg += text_at(left_ - 6, y + 4, "end", tick_text(std::pow(10, e)));
    }
    return svg;
  }

  std::string curve(const Curve& curve, const std::string& style, size_t place) const {
    std::string path, dots;
    for (const auto& [x, y] : curve.points) {
      if (x <= 0 || y <= 0) continue;
      path += (path.empty() ? "M" : "L") + number(x_at(x)) + " " + number(y_at(y));
      dots += "<circle cx=\"" + number(x_at(x)) + "\" cy=\"" + number(y_at(y)) +
              "\" r=\"2.5\" fill=\"none\" " + style + "/>\n";
    }
    const double x = left_ + 10, y = kTop + 14 + 17 * static_cast<double>(place);
    return "<path d=\"" + path + "\" fill=\"none\" stroke-width=\"2\" " + style + "/>\n" + dots +
           line(x, y - 4, x + 26, y - 4, "stroke-width=\"2\" " + style) +
           text_at(x + 32, y, "start", curve.label);
  }

  const CurveChart& chart_;
  double left_;
  Axis x_, y_;
};

}  // namespace

std::string to_svg(const std::vector<CurveChart>& charts) {
  const double width = kWidth * static_cast<double>(charts.size());
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(width) + "\" height=\"" +
                    number(kHeight) + "\" viewBox=\"0 0 " + number(width) + " " + number(kHeight) +
                    "\" font-family=\"system-ui, sans-serif\" font-size=\"12\">\n"
                    "<style>svg{color-scheme:light dark}text{fill:currentColor}</style>\n";
  for (size_t i = 0; i < charts.size(); ++i) svg += Plot(charts[i], kWidth * static_cast<double>(i)).svg();
  return svg + "</svg>\n";
}

}  // namespace halfspace::compare
