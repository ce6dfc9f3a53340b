// The result of `halfspace bench` as a table, JSON and SVG.
#include <cstdio>

#include "compare/bar_chart.h"
#include "compare/bench_workloads.h"
#include "compare/difference_text.h"
#include "compare/statistics_json.h"

namespace halfspace::compare {
namespace {

std::string label(const WorkloadRow& row) { return row.name + (row.draft ? " (draft)" : ""); }

const char* verdict(const WorkloadRow& row) {
  if (!row.same_picture) return "PICTURE";
  return row.fast() ? "met" : "MISSED";
}

std::string threads_text(const WorkloadRow& row) {
  if (row.speed_up == 0) return "-";
  char text[40];
  std::snprintf(text, sizeof text, "%.2f at %.0f%s", row.speed_up, row.core_distance_ns,
                row.speed_up < kTwoThreadsTarget ? " !" : "");
  return text;
}

std::string limit_text(const WorkloadRow& row) {
  if (!row.limit_ms || row.ours.cpu_ms.median <= 0) return "-";
  char text[40];
  std::snprintf(text, sizeof text, "%.0f %%", 100 * *row.limit_ms / row.ours.cpu_ms.median);
  return text;
}

std::string picture_text(const WorkloadRow& row) {
  if (!row.pictures) return "not compared";
  if (row.pictures->differing == 0) return "equal";
  char text[80];
  std::snprintf(text, sizeof text, "%.4f %% far, mean %.3f",
                100 * static_cast<double>(row.pictures->above_8) / static_cast<double>(row.pictures->pixels),
                row.pictures->mean);
  return text;
}

std::string text_row(const WorkloadRow& row) {
  char line[300];
  std::snprintf(line, sizeof line, "%-25s %9.3f %4.1f %% %9.3f %4.1f %% %8.2f %7.3g  %-8s %13s %7s  %s\n",
                label(row).c_str(), row.ours.cpu_ms.median, 100 * row.ours.cpu_ms.spread,
                row.theirs.cpu_ms.median, 100 * row.theirs.cpu_ms.spread, row.ratio.median, row.target,
                verdict(row), threads_text(row).c_str(), limit_text(row).c_str(), picture_text(row).c_str());
  return line;
}

std::string heading() {
  char line[300];
  std::snprintf(line, sizeof line, "%-25s %9s %6s %9s %6s %8s %7s  %-8s %13s %7s  %s\n", "workload",
                "ours ms", "+-", "theirs ms", "+-", "x as fast", "target", "", "2 threads", "limit",
                "picture");
  return line;
}

nlohmann::json json_of(const FrameTime& time) {
  return {{"cpu_ms", to_json(time.cpu_ms)}, {"wall_ms", to_json(time.wall_ms)}};
}

nlohmann::json json_of(const WorkloadRow& row) {
  nlohmann::json entry{{"name", row.name},
                       {"what", row.what},
                       {"draft", row.draft},
                       {"ours", json_of(row.ours)},
                       {"theirs", json_of(row.theirs)},
                       {"ratio", row.ratio.median},
                       {"ratio_spread", row.ratio.spread},
                       {"target", row.target},
                       {"same_picture", row.same_picture},
                       {"good", row.good()}};
  if (row.pictures) entry["picture"] = to_json(*row.pictures);
  if (row.limit_ms) entry["limit_ms"] = *row.limit_ms;
  if (row.speed_up > 0)
    entry["threads"] = {{"one", json_of(row.one_thread)},
                        {"two", json_of(row.two_threads)},
                        {"speed_up", row.speed_up},
                        {"core_distance_ns", row.core_distance_ns},
                        {"good", row.speed_up >= kTwoThreadsTarget}};
  return entry;
}

}  // namespace

std::string to_text(const WorkloadResult& result) {
  std::string text = "ours:   " + result.our_renderer + ", " + result.our_version + "\n" +
                     "theirs: " + result.their_renderer + ", " + result.their_version + "\n" + "on " +
                     result.processor + ", one thread on one core, 1024x1024, " +
                     std::to_string(result.options.rounds) + " alternating rounds\n\n" + heading();
  for (const WorkloadRow& row : result.rows) text += text_row(row);
  return text +
         "\nTimes are the process's CPU time of a frame, medians; +- is half the distance between the "
         "quartiles. x as fast:\nthe median of batches that followed each other. 2 threads: ours against "
         "ours "
         "with one, wall time, likewise, on two\ncores so many nanoseconds apart. limit: how near ours is to "
         "what this core could do at best. picture: pixels further\nthan 8 levels from theirs, and the mean "
         "distance in levels.\n";
}

nlohmann::json to_json(const WorkloadResult& result) {
  nlohmann::json rows = nlohmann::json::array();
  for (const WorkloadRow& row : result.rows) rows.push_back(json_of(row));
  return {{"ours", {{"renderer", result.our_renderer}, {"version", result.our_version}}},
          {"theirs", {{"renderer", result.their_renderer}, {"version", result.their_version}}},
          {"processor", result.processor},
          {"rounds", result.options.rounds},
          {"workloads", rows},
          {"good", all_good(result)}};
}

std::string to_svg(const WorkloadResult& result) {
  const bool builds = result.options.against.has_value();
  BarChart chart{builds ? "How many times as fast as the other build, one thread"
                        : "How many times as fast as Mesa's OSMesa, one thread each",
                 "x",
                 1,
                 builds                    ? "other build"
                 : result.options.softpipe ? "softpipe"
                                           : "llvmpipe",
                 {}};
  for (const WorkloadRow& row : result.rows)
    chart.bars.push_back({label(row), row.ratio.median, builds ? 0 : row.target, row.good()});
  return to_svg(chart);
}

}  // namespace halfspace::compare
