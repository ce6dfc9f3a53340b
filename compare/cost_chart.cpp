#include "compare/cost_chart.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "compare/chart_axis.h"
#include "compare/svg.h"

namespace halfspace::compare {
namespace {

struct Box {
  double x0, y0, x1, y1;
  bool meets(const Box& other) const {
    return x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1;
  }
};

// Labels beside points, where nothing is yet.
class Labels {
 public:
  Labels(Svg& svg, const Box& frame) : svg_(svg), frame_(frame) {}

  void keep_free(const Box& box) { taken_.push_back(box); }
  // False, and nothing written, when there is no room and the label is not `needed`.
  bool put(double x, double y, const std::string& words, const Svg::TextStyle& style, bool needed) {
    const double width = text_width(words, style.size), height = style.size;
    const Box choices[] = {{x + 8, y - height / 2, x + 8 + width, y + height / 2},
                           {x - 8 - width, y - height / 2, x - 8, y + height / 2},
                           {x + 6, y - 6 - height, x + 6 + width, y - 6},
                           {x + 6, y + 6, x + 6 + width, y + 6 + height},
                           {x - 6 - width, y - 6 - height, x - 6, y - 6},
                           {x - 6 - width, y + 6, x - 6, y + 6 + height},
                           {x - width / 2, y - 9 - height, x + width / 2, y - 9},
                           {x - width / 2, y + 9, x + width / 2, y + 9 + height}};
    const Box* place =
        std::find_if(std::begin(choices), std::end(choices), [this](const Box& box) { return is_free(box); });
    if (place == std::end(choices)) {
      if (!needed) return false;
      place = choices;
    }
    taken_.push_back(*place);
    svg_.text(place->x0, place->y1 - 2, words, style);
    return true;
  }

 private:
  bool is_free(const Box& box) const {
    if (box.x0 < frame_.x0 || box.x1 > frame_.x1 || box.y0 < frame_.y0 || box.y1 > frame_.y1) return false;
    return std::none_of(taken_.begin(), taken_.end(), [&box](const Box& other) { return box.meets(other); });
  }

  Svg& svg_;
  Box frame_;
  std::vector<Box> taken_;
};

bool can_be_drawn(const CostPoint& point) { return point.error && point.ratio.median > 0; }

constexpr double kFewestWrong = 1e-4, kMostWrong = 100;  // per cent

// Powers of two around all the times.
std::pair<double, double> time_range(const CostScene& scene) {
  double lowest = 0.75, highest = 1.5;
  for (const CostPoint& point : scene.points) {
    if (!can_be_drawn(point)) continue;
    lowest = std::min(lowest, point.ratio.median), highest = std::max(highest, point.ratio.median);
  }
  return {std::exp2(std::floor(std::log2(lowest * 0.98))), std::exp2(std::ceil(std::log2(highest * 1.02)))};
}

class ScatterPanel {
 public:
  ScatterPanel(Svg& svg, const CostScene& scene, const Box& frame, bool small)
      : svg_(svg),
        scene_(scene),
        frame_(frame),
        small_(small),
        x_(time_range(scene).first, time_range(scene).second, frame.x0, frame.x1, false),
        y_(kFewestWrong, kMostWrong, frame.y1 - 20, frame.y0 + 4, true) {}

  void draw() {
    grid();
    front();
    Labels labels(svg_, {frame_.x0 + 2, frame_.y0, frame_.x1 + (small_ ? 4 : 110), frame_.y1});
    for (const CostPoint& point : scene_.points) {
      if (!can_be_drawn(point)) continue;
      dot(point);
      const double r = radius(point) + 1;
      labels.keep_free({px(point) - r, py(point) - r, px(point) + r, py(point) + r});
    }
    for (const bool needed : {true, false})
      for (const CostPoint& point : scene_.points)
        if (can_be_drawn(point) && is_whole(point) == needed && (needed || !small_))
          label(point, labels, needed);
  }

 private:
  // A level of the whole dial, or another renderer; not one axis alone.
  static bool is_whole(const CostPoint& point) { return point.setting.axis.empty(); }
  static const char* color(const CostPoint& point) {
    return point.setting.library == Library::mesa ? ink::kTheirs : ink::kOurs;
  }
  static double radius(const CostPoint& point) { return is_whole(point) ? 5 : 2.5; }
  double px(const CostPoint& point) const { return x_.place(point.ratio.median); }
  double py(const CostPoint& point) const { return y_.place(point.error->wrong_percent()); }

  void grid() {
    const int size = small_ ? 10 : 12;
    for (const Tick& tick : x_.ticks(2, "x")) {
      svg_.line(x_.place(tick.value), frame_.y0, x_.place(tick.value), frame_.y1, ink::kGrid);
      svg_.text(x_.place(tick.value), frame_.y1 + 16, tick.label, {"middle", ink::kSoft, size});
    }
    for (const Tick& tick : y_.ticks(10, "%")) {
      svg_.line(frame_.x0, y_.place(tick.value), frame_.x1, y_.place(tick.value), ink::kGrid);
      svg_.text(frame_.x0 - 6, y_.place(tick.value) + 4, tick.label, {"end", ink::kSoft, size});
    }
    svg_.line(frame_.x0, y_.zero_place(), frame_.x1, y_.zero_place(), ink::kSoft);
    svg_.text(frame_.x0 - 6, y_.zero_place() + 4, "none", {"end", ink::kSoft, size});
  }

  // Steps: until the next point of the front, nothing better is to be had.
  void front() {
    const std::vector<const CostPoint*> front = pareto_front(scene_);
    if (front.empty()) return;
    svg_.line(px(*front.front()), frame_.y0, px(*front.front()), py(*front.front()), ink::kFront, 1.5, "5 3");
    for (size_t i = 0; i + 1 < front.size(); ++i) {
      svg_.line(px(*front[i]), py(*front[i]), px(*front[i + 1]), py(*front[i]), ink::kFront, 1.5);
      svg_.line(px(*front[i + 1]), py(*front[i]), px(*front[i + 1]), py(*front[i + 1]), ink::kFront, 1.5);
    }
    svg_.line(px(*front.back()), py(*front.back()), frame_.x1, py(*front.back()), ink::kFront, 1.5, "5 3");
  }

  void dot(const CostPoint& point) {
    svg_.circle(px(point), py(point), radius(point), color(point), is_whole(point) ? "#ffffff" : "none");
  }

  void label(const CostPoint& point, Labels& labels, bool needed) {
    Svg::TextStyle style;
    style.color = needed ? color(point) : ink::kSoft;
    style.size = small_ || !needed ? 10 : 13;
    style.bold = needed;
    labels.put(px(point), py(point), point.setting.name, style, needed);
  }

  Svg& svg_;
  const CostScene& scene_;
  Box frame_;
  bool small_;
  LogAxis x_, y_;
};

constexpr const char* kTimeLabel = "processor time of a frame, as a multiple of standard's";
constexpr const char* kErrorLabel = "pixels that are not the nearest bytes to the truth";

}  // namespace

std::string scene_chart(const CostScene& scene) {
  Svg svg(880, 540);
  svg.text(16, 26, "Time over error: " + scene.name, {"start", ink::kText, 16, true});
  svg.text(16, 46, std::string("up: ") + kErrorLabel + "; across: " + kTimeLabel, {"start", ink::kSoft, 12});
  ScatterPanel(svg, scene, {70, 66, 760, 490}, false).draw();
  svg.text(70, 528,
           "green: the Pareto front, the settings no other beats in both. Small dots: one axis of the dial "
           "turned alone.",
           {"start", ink::kSoft, 12});
  return svg.str();
}

std::string scenes_chart(const CostResult& result) {
  constexpr double kWide = 460, kHigh = 290;
  constexpr size_t kColumns = 2;
  const size_t rows = (result.scenes.size() + kColumns - 1) / kColumns;
  Svg svg(kColumns * kWide, 40 + kHigh * static_cast<double>(rows));
  svg.text(16, 24, std::string("Scene by scene. Up: ") + kErrorLabel + "; across: " + kTimeLabel,
           {"start", ink::kSoft, 12});
  for (size_t i = 0; i < result.scenes.size(); ++i) {
    const double x = kWide * static_cast<double>(i % kColumns),
                 y = 40 + kHigh * static_cast<double>(i / kColumns);
    svg.text(x + 60, y + 12, result.scenes[i].name, {"start", ink::kText, 13, true});
    ScatterPanel(svg, result.scenes[i], {x + 60, y + 20, x + kWide - 25, y + kHigh - 34}, true).draw();
  }
  return svg.str();
}

namespace {

const CostPoint* find_point(const CostScene& scene, const std::string& axis, const std::string& level) {
  for (const CostPoint& point : scene.points)
    if (point.setting.axis == axis && point.setting.level == level && can_be_drawn(point)) return &point;
  return nullptr;
}

std::vector<std::string> axes_of(const CostScene& scene) {
  std::vector<std::string> axes;
  for (const CostPoint& point : scene.points)
    if (!point.setting.axis.empty() && (axes.empty() || axes.back() != point.setting.axis))
      axes.push_back(point.setting.axis);
  return axes;
}

class AxesPanel {
 public:
  static constexpr double kTop = 84, kRow = 34, kTime0 = 150, kTime1 = 480, kError0 = 560, kError1 = 850;

  AxesPanel(Svg& svg, const CostScene& scene, size_t rows)
      : svg_(svg),
        scene_(scene),
        bottom_(kTop + kRow * static_cast<double>(rows)),
        time_(time_range(scene)),
        error_(kFewestWrong, kMostWrong, kError0, kError1, true) {}

  void grid() {
    const double range = time_.second - time_.first, step = range > 3 ? 1 : range > 1.2 ? 0.5 : 0.1;
    for (double ratio = std::ceil(time_.first / step) * step; ratio <= time_.second * 1.001; ratio += step) {
      svg_.line(time_place(ratio), kTop - 8, time_place(ratio), bottom_, ink::kGrid);
      svg_.text(time_place(ratio), bottom_ + 16, tick_label(std::round(ratio * 10) / 10) + "x",
                {"middle", ink::kSoft, 11});
    }
    svg_.line(time_place(1), kTop - 8, time_place(1), bottom_, ink::kSoft);
    for (const Tick& tick : error_.ticks(10, "%")) {
      svg_.line(error_.place(tick.value), kTop - 8, error_.place(tick.value), bottom_, ink::kGrid);
      // The first stands too near to "none".
      if (tick.value < 2 * kFewestWrong) continue;
      svg_.text(error_.place(tick.value), bottom_ + 16, tick.label, {"middle", ink::kSoft, 10});
    }
    svg_.line(error_.zero_place(), kTop - 8, error_.zero_place(), bottom_, ink::kSoft);
    svg_.text(error_.zero_place(), bottom_ + 16, "none", {"middle", ink::kSoft, 10});
  }

  void row(size_t index, const std::string& axis) {
    const double y = kTop + kRow * (static_cast<double>(index) + 0.5);
    const bool dial = axis.empty();
    svg_.text(kTime0 - 16, y + 4, dial ? "all of them" : axis, {"end", ink::kText, 13, dial});
    const CostPoint* draft = find_point(scene_, axis, "draft");
    const CostPoint* standard = find_point(scene_, "", "standard");
    const CostPoint* exact = find_point(scene_, axis, "exact");
    if (!draft || !standard || !exact) return;
    svg_.line(time_place(draft->ratio.median), y, time_place(exact->ratio.median), y, ink::kOurs, 2);
    svg_.line(error_place(*draft), y, error_place(*exact), y, ink::kOurs, 2);
    mark(time_place(exact->ratio.median), error_place(*exact), y, ink::kOurs, 6);
    mark(time_place(1), error_place(*standard), y, "#9db9ee", 5);
    mark(time_place(draft->ratio.median), error_place(*draft), y, "#ffffff", 4);
  }

 private:
  // Linear, by tenths: most axes change the time by a few per cent.
  static std::pair<double, double> time_range(const CostScene& scene) {
    double lowest = 0.9, highest = 1.1;
    for (const CostPoint& point : scene.points) {
      if (point.setting.library != Library::ours || !can_be_drawn(point)) continue;
      lowest = std::min(lowest, point.ratio.median), highest = std::max(highest, point.ratio.median);
    }
    return {std::floor(lowest * 10) / 10, std::ceil(highest * 10) / 10};
  }

  double time_place(double ratio) const {
    return std::lerp(kTime0, kTime1, (ratio - time_.first) / (time_.second - time_.first));
  }
  double error_place(const CostPoint& point) const { return error_.place(point.error->wrong_percent()); }
  void mark(double time, double error, double y, const char* fill, double radius) {
    svg_.circle(time, y, radius, fill, ink::kOurs);
    svg_.circle(error, y, radius, fill, ink::kOurs);
  }

  Svg& svg_;
  const CostScene& scene_;
  double bottom_;
  std::pair<double, double> time_;
  LogAxis error_;
};

}  // namespace

std::string axes_chart(const CostScene& scene) {
  const std::vector<std::string> axes = axes_of(scene);
  Svg svg(880, AxesPanel::kTop + AxesPanel::kRow * static_cast<double>(axes.size() + 1) + 56);
  svg.text(16, 26, "One axis of the dial at a time: " + scene.name, {"start", ink::kText, 16, true});
  svg.text(16, 46, "white: draft; light: standard; dark: exact", {"start", ink::kSoft, 12});
  svg.text(AxesPanel::kTime0, 68, "time, standard's is 1", {"start", ink::kText, 13, true});
  svg.text(AxesPanel::kError0, 68, "pixels not the nearest bytes", {"start", ink::kText, 13, true});
  AxesPanel panel(svg, scene, axes.size() + 1);
  panel.grid();
  panel.row(0, "");
  for (size_t i = 0; i < axes.size(); ++i) panel.row(i + 1, axes[i]);
  return svg.str();
}

}  // namespace halfspace::compare
