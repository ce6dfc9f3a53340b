#include "compare/bench_scale.h"

#include <algorithm>
#include <cstdio>

#include "compare/curve_chart.h"
#include "compare/processor.h"

namespace halfspace::compare {
namespace {

using Json = nlohmann::json;

bool is_chosen(const ScaleOptions& options, const std::string& name) {
  return options.only.empty() ||
         std::find(options.only.begin(), options.only.end(), name) != options.only.end();
}

// After the frames, the peak over what was resident before the first of them; and what the context took
// before that.
double library_mib(const Json& before, const Json& after, double color_buffer_mib) {
  const double drawing = after.at("peak_kib").get<double>() - before.at("resident_kib").get<double>();
  return (drawing + before.at("context_kib").get<double>()) / 1024 - color_buffer_mib;
}

class ScaleBench {
 public:
  explicit ScaleBench(const ScaleOptions& options) : options_(options) {}

  ScalePoint measure(const std::string& scale, int amount, ScaleResult& result) {
    const std::vector<int> core{core_to_use(options_.core)};
    const auto ours = start_halfspace(HalfspaceSetting{options_.library}, core),
               theirs = start_mesa(false, core);
    const std::string order = "scale " + scale + " " + std::to_string(amount);
    result.ours = require_halfspace(ours->order(order));
    result.theirs = require_mesa(theirs->order(order));
    const Json our_memory = ours->order("memory"), their_memory = theirs->order("memory");
    const Turns times = take_turns(*ours, *theirs, options_.rounds);
    const double edge = scale == "pixels" ? amount : 1024;
    const double color_buffer_mib = edge * edge * 4 / (1024 * 1024);
    return {amount,
            times.first,
            times.second,
            times.cpu_ratio,
            library_mib(our_memory, ours->order("memory"), color_buffer_mib),
            library_mib(their_memory, theirs->order("memory"), color_buffer_mib)};
  }

 private:
  ScaleOptions options_;
};

Json json_of(const FrameTime& time) {
  return {{"cpu_ms", time.cpu_ms.median}, {"wall_ms", time.wall_ms.median}, {"spread", time.cpu_ms.spread}};
}

}  // namespace

ScaleResult bench_scale(const ScaleOptions& options,
                        const std::function<void(const std::string&)>& progress) {
  ScaleResult result;
  result.processor = processor_name();
  ScaleBench bench(options);
  const Json list = start_halfspace(HalfspaceSetting{options.library}, {})->order("list");
  for (const Json& entry : list.at("scales")) {
    ScaleCurve curve{entry.at("name"), entry.at("what"), {}};
    if (!is_chosen(options, curve.name)) continue;
    for (const int amount : entry.at("amounts")) {
      if (options.most > 0 && amount > options.most) continue;
      progress(curve.name + " " + std::to_string(amount));
      curve.points.push_back(bench.measure(curve.name, amount, result));
    }
    result.curves.push_back(std::move(curve));
  }
  if (result.curves.empty()) throw std::runtime_error("no scale is called that");
  return result;
}

std::string to_text(const ScaleResult& result) {
  std::string text = "ours:   " + result.ours.renderer + "\ntheirs: " + result.theirs.renderer + "\non " +
                     result.processor + ", one thread on one core\n";
  char line[200];
  for (const ScaleCurve& curve : result.curves) {
    text += "\n" + curve.name + ": " + curve.what + "\n";
    std::snprintf(line, sizeof line, "%12s %12s %12s %10s %12s %12s\n", "", "ours ms", "theirs ms",
                  "x as fast", "ours MB", "theirs MB");
    text += line;
    for (const ScalePoint& point : curve.points) {
      std::snprintf(line, sizeof line, "%12d %12.3f %12.3f %10.2f %12.1f %12.1f\n", point.amount,
                    point.ours.cpu_ms.median, point.theirs.cpu_ms.median, point.ratio.median, point.our_mib,
                    point.their_mib);
      text += line;
    }
  }
  return text +
         "\nTimes are the process's CPU time of a frame, medians. Memory is the most the library took beyond "
         "the "
         "application's.\n";
}

nlohmann::json to_json(const ScaleResult& result) {
  Json curves = Json::array();
  for (const ScaleCurve& curve : result.curves) {
    Json points = Json::array();
    for (const ScalePoint& point : curve.points)
      points.push_back({{"amount", point.amount},
                        {"ours", json_of(point.ours)},
                        {"theirs", json_of(point.theirs)},
                        {"ratio", point.ratio.median},
                        {"our_mib", point.our_mib},
                        {"their_mib", point.their_mib}});
    curves.push_back({{"name", curve.name}, {"what", curve.what}, {"points", points}});
  }
  return {{"ours", result.ours.renderer},
          {"theirs", result.theirs.renderer},
          {"processor", result.processor},
          {"curves", curves}};
}

std::string to_svg(const ScaleCurve& curve) {
  CurveChart time{"Time of a frame", curve.what, " ms", {{"Halfspace", {}}, {"llvmpipe", {}}}};
  CurveChart memory{
      "Memory beyond the application's", curve.what, " MB", {{"Halfspace", {}}, {"llvmpipe", {}}}};
  for (const ScalePoint& point : curve.points) {
    time.curves[0].points.emplace_back(point.amount, point.ours.cpu_ms.median);
    time.curves[1].points.emplace_back(point.amount, point.theirs.cpu_ms.median);
    memory.curves[0].points.emplace_back(point.amount, point.our_mib);
    memory.curves[1].points.emplace_back(point.amount, point.their_mib);
  }
  memory.x_label.clear();
  return to_svg({time, memory});
}

}  // namespace halfspace::compare
