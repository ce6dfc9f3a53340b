#include "compare/curve_chart.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/chart_axis.h"
#include "compare/svg.h"

namespace halfspace::compare {
namespace {

constexpr double kWidth = 400, kHeight = 288;
constexpr double kLeft = 74, kRight = 28, kTop = 66, kBottom = 46;
constexpr double kKey = 24;  // the length of a curve's piece in the legend

// Told apart by colour and by dashes.
struct Style {
  const char* color;
  const char* dashes;
};
constexpr std::array<Style, 3> kStyles{{{ink::kOurs, ""}, {ink::kTheirs, "5 3"}, {ink::kFront, "2 3"}}};

bool is_shown(const std::pair<double, double>& point) { return point.first > 0 && point.second > 0; }

// Whole powers of ten around what is shown.
struct Range {
  double low = HUGE_VAL, high = -HUGE_VAL;  // exponents

  void take(double value) {
    low = std::min(low, std::floor(std::log10(value)));
    high = std::max(high, std::ceil(std::log10(value)));
  }
  LogAxis axis(double from, double to) const {
    const double first = std::isfinite(low) ? low : 0;
    return {std::pow(10, first), std::pow(10, std::max(high, first + 1)), from, to, false};
  }
};

LogAxis axis_of(const CurveChart& chart, double (*part)(const std::pair<double, double>&), double from,
                double to) {
  Range range;
  for (const Curve& curve : chart.curves)
    for (const auto& point : curve.points)
      if (is_shown(point)) range.take(part(point));
  return range.axis(from, to);
}

class Plot {
 public:
  Plot(Svg& svg, const CurveChart& chart, double left)
      : svg_(svg),
        chart_(chart),
        left_(left),
        x_(axis_of(
            chart, [](const auto& point) { return point.first; }, left + kLeft, left + kWidth - kRight)),
        y_(axis_of(
            chart, [](const auto& point) { return point.second; }, kHeight - kBottom, kTop)) {}

  void draw() {
    svg_.text(left_ + 16, 22, chart_.title, {"start", ink::kText, 14, true});
    grid();
    double key = left_ + 16;
    for (size_t i = 0; i < chart_.curves.size(); ++i) {
      curve(chart_.curves[i], kStyles[i % kStyles.size()]);
      key += legend(chart_.curves[i], kStyles[i % kStyles.size()], key);
    }
    svg_.text(left_ + kLeft, kHeight - 8, chart_.x_label, {"start", ink::kSoft});
  }

 private:
  void grid() {
    for (const Tick& tick : x_.ticks(10, "")) {
      const double x = x_.place(tick.value);
      svg_.line(x, kTop, x, kHeight - kBottom, ink::kGrid);
      svg_.text(x, kHeight - kBottom + 16, tick.label, {"middle", ink::kSoft});
    }
    for (const Tick& tick : y_.ticks(10, chart_.y_unit.c_str())) {
      const double y = y_.place(tick.value);
      svg_.line(left_ + kLeft, y, left_ + kWidth - kRight, y, ink::kGrid);
      svg_.text(left_ + kLeft - 6, y + 4, tick.label, {"end", ink::kSoft});
    }
  }

  void curve(const Curve& curve, const Style& style) {
    const std::pair<double, double>* before = nullptr;
    for (const auto& point : curve.points) {
      if (!is_shown(point)) continue;
      const double x = x_.place(point.first), y = y_.place(point.second);
      if (before)
        svg_.line(x_.place(before->first), y_.place(before->second), x, y, style.color, 2, style.dashes);
      svg_.circle(x, y, 2.5, style.color);
      before = &point;
    }
  }

  // Returns its width.
  double legend(const Curve& curve, const Style& style, double x) {
    constexpr double kBase = 44;
    svg_.line(x, kBase - 4, x + kKey, kBase - 4, style.color, 2, style.dashes);
    svg_.text(x + kKey + 5, kBase, curve.label, {"start", style.color});
    return kKey + 5 + text_width(curve.label) + 12;
  }

  Svg& svg_;
  const CurveChart& chart_;
  double left_;
  LogAxis x_, y_;
};

}  // namespace

std::string to_svg(const std::vector<CurveChart>& charts) {
  Svg svg(kWidth * static_cast<double>(charts.size()), kHeight);
  for (size_t i = 0; i < charts.size(); ++i) Plot(svg, charts[i], kWidth * static_cast<double>(i)).draw();
  return svg.str();
}

}  // namespace halfspace::compare
