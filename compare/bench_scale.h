// What `halfspace bench scale` measures: how time and memory grow with what is drawn.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/contest.h"

namespace halfspace::compare {

struct ScaleOptions {
  std::vector<std::string> only;  // names of scales; empty: all
  double most = 0;                // leaves larger amounts out; 0: none
  int rounds = 3;
  int core = -1;
  std::optional<std::string> library;
  std::filesystem::path out = "out/bench";
};

struct ScalePoint {
  int amount = 0;
  FrameTime ours, theirs;
  Summary ratio;  // their process time / ours, of neighbours
  // What the library took at most while it drew, beyond the memory of the application, its colour buffer
  // included.
  double our_mib = 0, their_mib = 0;
};

struct ScaleCurve {
  std::string name, what;
  std::vector<ScalePoint> points;
};

struct ScaleResult {
  Drawer ours, theirs;
  std::string processor;
  std::vector<ScaleCurve> curves;
};

// `progress` is told what is being measured. Throws what the contest throws.
ScaleResult bench_scale(const ScaleOptions& options, const std::function<void(const std::string&)>& progress);

std::string to_text(const ScaleResult& result);
nlohmann::json to_json(const ScaleResult& result);
// Time and memory side by side.
std::string to_svg(const ScaleCurve& curve);

}  // namespace halfspace::compare
