// The result of `halfspace bench scenes` as a table, JSON and SVG.
#include <cstdio>

#include "compare/bar_chart.h"
#include "compare/bench_scenes.h"
#include "compare/difference_text.h"
#include "compare/statistics_json.h"

namespace halfspace::compare {
namespace {

std::string mark(const BenchRow& row) { return !row.good ? "-" : *row.good ? "pass" : "FAIL"; }

std::string heading(const char* what, const char* ours, const char* theirs) {
  char line[160];
  std::snprintf(line, sizeof line, "%-36s %10s %7s %10s %7s  %8s %8s\n", what, ours, "+-", theirs, "+-",
                "ratio", "target");
  return line;
}

std::string text_row(const BenchRow& row) {
  char line[300];
  std::snprintf(line, sizeof line, "%-36s %7.2f %-2s %5.1f %% %7.2f %-2s %5.1f %%  %8.3f %s%7.3g  %s%s%s\n",
                row.what.c_str(), row.ours.median, row.unit.c_str(), 100 * row.ours.spread, row.theirs.median,
                row.unit.c_str(), 100 * row.theirs.spread, row.ratio.median, row.higher_is_better ? ">" : "<",
                row.target, mark(row).c_str(), row.remark.empty() ? "" : "  ", row.remark.c_str());
  return line;
}

nlohmann::json json_of(const std::vector<BenchRow>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const BenchRow& row : rows) {
    nlohmann::json entry{{"what", row.what},          {"unit", row.unit},
                         {"ours", to_json(row.ours)}, {"theirs", to_json(row.theirs)},
                         {"ratio", row.ratio.median}, {"ratio_spread", row.ratio.spread},
                         {"target", row.target},      {"higher_is_better", row.higher_is_better},
                         {"remark", row.remark}};
    entry["good"] = row.good ? nlohmann::json(*row.good) : nlohmann::json(nullptr);
    list.push_back(entry);
  }
  return list;
}

}  // namespace

std::string to_text(const BenchResult& result) {
  std::string text = "ours:   " + result.our_renderer + ", " + result.our_version + "\n" +
                     "theirs: " + result.their_renderer + ", " + result.their_version + "\n" + "on " +
                     result.processor + ", one thread on one core, " + std::to_string(result.options.width) +
                     "x" + std::to_string(result.options.height) + ", " +
                     std::to_string(result.options.pairs) + " alternating pairs of " +
                     std::to_string(result.options.frames) + " frames\n\n";
  text += heading("clear + draw + finish", "ours", "OSMesa");
  for (const BenchRow& row : result.scenes) text += text_row(row);
  text += "\n" + heading("besides", "ours", "other");
  for (const BenchRow& row : result.others) text += text_row(row);
  return text +
         "\n+- is half the distance between the quartiles. ratio: the median of the pairs. Threads: two "
         "beside "
         "one, both ours.\n";
}

nlohmann::json to_json(const BenchResult& result) {
  return {{"ours", {{"renderer", result.our_renderer}, {"version", result.our_version}}},
          {"theirs", {{"renderer", result.their_renderer}, {"version", result.their_version}}},
          {"processor", result.processor},
          {"width", result.options.width},
          {"height", result.options.height},
          {"pairs", result.options.pairs},
          {"frames", result.options.frames},
          {"scenes", json_of(result.scenes)},
          {"others", json_of(result.others)},
          {"good", all_good(result)}};
}

std::string to_svg(const BenchResult& result) {
  BarChart chart{"Time of a frame at one thread, as a share of OSMesa's", "", 1, "OSMesa llvmpipe", {}};
  for (const BenchRow& row : result.scenes)
    chart.bars.push_back({row.what, row.ratio.median, row.target, row.good.value_or(true)});
  return to_svg(chart);
}

}  // namespace halfspace::compare
