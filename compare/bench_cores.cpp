#include "compare/bench_cores.h"

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "compare/contest.h"
#include "compare/curve_chart.h"
#include "compare/processor.h"
#include "compare/schedule.h"

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Rows worth a curve each: fills, textures, triangles small and large, meshes, calls.
const std::vector<std::string> kUsual{"fill_blend",     "tex_full",           "tri_10px",
                                      "tri_1000px",     "mesh_indexed_1M",    "mesh_lit8",
                                      "immediate_200k", "many_state_changes", "points"};

class CoresBench {
 public:
  explicit CoresBench(const CoresOptions& options) : options_(options) {}

  CoresRow measure(const std::string& name, std::string& renderer) {
    CoresRow row;
    row.name = name;
    row.one_ms = one_thread_ms(name, renderer);
    for (const int cores : options_.cores) {
      const Schedule schedule = cores == 1 ? Schedule{row.one_ms, row.one_ms, 1}
                                           : simulate(record(name, cores), cores, options_.wake_us);
      row.frame_ms.push_back(schedule.frame_ms);
      row.work_ms.push_back(schedule.work_ms);
      row.serial_share.push_back(schedule.serial_share);
    }
    return row;
  }

 private:
  double one_thread_ms(const std::string& name, std::string& renderer) {
    const auto drawer = start_halfspace(HalfspaceSetting{options_.library}, {});
    renderer = require_halfspace(drawer->order("open " + name)).renderer;
    drawer->order("run 2");
    std::vector<double> times;
    for (int i = 0; i < options_.frames; ++i) times.push_back(drawer->order("run 1").at("cpu_ms"));
    return summarize(times).median;
  }

  // With so many threads, on the cores there are: the times of tasks are CPU time.
  Trace record(const std::string& name, int threads) {
    fs::create_directories(options_.out);
    const fs::path path = fs::absolute(options_.out) / "trace.txt";
    fs::remove(path);
    {
      HalfspaceSetting setting;
      setting.folder = options_.library;
      setting.threads = threads;
      setting.trace = path.string();
      const auto drawer = start_halfspace(setting, {});
      drawer->order("open " + name);
      drawer->order("run " + std::to_string(options_.frames + 1));
      drawer->order("close");
    }
    std::ifstream file(path);
    const Trace trace = read_trace(file);
    fs::remove(path);
    return trace;
  }

  CoresOptions options_;
};

}  // namespace

CoresResult bench_cores(const CoresOptions& options,
                        const std::function<void(const std::string&)>& progress) {
  CoresResult result;
  result.options = options;
  result.processor = processor_name();
  CoresBench bench(options);
  for (const std::string& name : options.only.empty() ? kUsual : options.only) {
    progress(name);
    result.rows.push_back(bench.measure(name, result.renderer));
  }
  return result;
}

std::string to_text(const CoresResult& result) {
  std::string text = result.renderer + " on " + result.processor + "\n\n";
  char cell[80];
  std::snprintf(cell, sizeof cell, "%-22s %9s %8s", "times as fast", "1 core ms", "serial");
  text += cell;
  for (const int cores : result.options.cores) {
    std::snprintf(cell, sizeof cell, " %8d", cores);
    text += cell;
  }
  text += "\n";
  for (const CoresRow& row : result.rows) {
    std::snprintf(cell, sizeof cell, "%-22s %9.2f %6.1f %%", row.name.c_str(), row.one_ms,
                  100 * row.serial_share.back());
    text += cell;
    for (const double frame_ms : row.frame_ms) {
      std::snprintf(cell, sizeof cell, " %8.2f", row.one_ms / frame_ms);
      text += cell;
    }
    text += "\n";
  }
  std::snprintf(cell, sizeof cell, "\nserial: of the work with %d threads. ", result.options.cores.back());
  text += cell;
  return text +
         "Simulated from recorded tasks, but for one core: what the cores cost\neach other in memory traffic "
         "is left "
         "out.\n";
}

nlohmann::json to_json(const CoresResult& result) {
  Json rows = Json::array();
  for (const CoresRow& row : result.rows)
    rows.push_back({{"name", row.name},
                    {"one_ms", row.one_ms},
                    {"frame_ms", row.frame_ms},
                    {"work_ms", row.work_ms},
                    {"serial_share", row.serial_share}});
  return {{"renderer", result.renderer},
          {"processor", result.processor},
          {"cores", result.options.cores},
          {"wake_us", result.options.wake_us},
          {"workloads", rows}};
}

std::string to_svg(const CoresResult& result) {
  CurveChart ideal{"Times as fast as one core, simulated", "cores", "x", {}};
  std::vector<CurveChart> charts;
  constexpr size_t kCurves = 3;  // a chart
  for (size_t i = 0; i < result.rows.size(); ++i) {
    if (i % kCurves == 0) charts.push_back(ideal);
    Curve curve{result.rows[i].name, {}};
    for (size_t k = 0; k < result.options.cores.size(); ++k)
      curve.points.emplace_back(result.options.cores[k], result.rows[i].one_ms / result.rows[i].frame_ms[k]);
    charts.back().curves.push_back(std::move(curve));
  }
  return to_svg(charts);
}

}  // namespace halfspace::compare
