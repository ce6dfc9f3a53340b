// What `halfspace bench scenes` measures, and against which targets.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/scene_run.h"
#include "compare/statistics.h"

namespace halfspace::compare {

struct BenchOptions {
  std::vector<int> scenes;  // empty: all eight
  int pairs = 11;           // ours, theirs, ours, theirs, ...
  int frames = 10;          // per process; their median is one value
  int width = 1024, height = 1024;
  int core = -1;  // the core both are pinned to; -1: the last one we may use
  std::optional<std::string> library;
  std::filesystem::path out = "out/bench";
};

// One line of the result. `ratio` is what the target speaks of; good means it keeps it.
struct BenchRow {
  std::string what;
  Summary ours, theirs;  // for thread scaling: two threads, one thread
  std::string unit;      // "ms", "MB"
  Summary ratio;         // ours / theirs, of pairs; or ours alone for memory, speed-up for threads
  double target = 0;
  bool higher_is_better = false;
  std::optional<bool> good;  // none when there is nothing to judge, as with one core
  std::string remark;
};

struct BenchResult {
  std::string our_renderer, their_renderer, our_version, their_version, processor;
  BenchOptions options;
  std::vector<BenchRow> scenes;
  std::vector<BenchRow> others;  // start-up, threads, memory
};

// Ours may take at most this share of OSMesa's time on a scene of 1 .. 8.
double scene_target(int scene);

// `progress` is told what is being measured. Throws what run_scenes throws.
BenchResult bench_scenes(const BenchOptions& options,
                         const std::function<void(const std::string&)>& progress);

bool all_good(const BenchResult& result);
std::string to_text(const BenchResult& result);
nlohmann::json to_json(const BenchResult& result);
// The scenes' share of OSMesa's time, as bars.
std::string to_svg(const BenchResult& result);

}  // namespace halfspace::compare
