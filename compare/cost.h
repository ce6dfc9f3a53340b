// What accuracy costs in time, and what it buys in pixels: `halfspace cost`.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/cost_settings.h"
#include "compare/scene_program.h"
#include "compare/statistics.h"
#include "compare/truth.h"

namespace halfspace::compare {

struct CostOptions {
  std::vector<std::string> scenes;  // of ref_app: numbers or names; empty: all eight, unless cases are stated
  std::vector<std::string> cases;   // hard cases, by name, or "all"
  std::vector<std::string> program;  // with arguments; drawn in place of scenes
  int frame = 0;                     // of the program: which one is judged
  bool axes = true, mesa = true;     // measure each axis alone; measure OSMesa
  int rounds = 7;                    // of all settings in turn
  int frames = 5;                    // a process, timed; their median is one value
  int width = 512, height = 512;
  int core = -1;  // the core all are pinned to; -1: the last one we may use
  LibraryFolders folders;
  std::filesystem::path out = "out/cost";
};

// One scene drawn by one setting. No time or no error where it could not be had.
struct CostPoint {
  Setting setting;
  Summary ms;     // processor time of a frame, over the rounds
  Summary ratio;  // to standard in the same round
  std::optional<TruthError> error;
};

struct CostScene {
  std::string name;
  std::vector<CostPoint> points;  // in the order of the settings
};

struct CostResult {
  CostOptions options;
  std::string processor, our_renderer, our_version, oracle, mesa_version;
  std::vector<CostScene> scenes;
};

using Progress = std::function<void(const std::string&)>;

// Throws what draw_scenes throws, and ImageError.
CostResult measure_cost(const CostOptions& options, const Progress& progress);

// All scenes as one: the geometric mean of the ratios, the errors of all pixels together.
CostScene all_scenes(const CostResult& result);

// The points that no other beats in both time and error, the fastest first. Times within their spreads, or
// within two per cent, are taken as the same; then the simpler setting stands, standard before all. Points
// without a time or an error are left out.
std::vector<const CostPoint*> pareto_front(const CostScene& scene);

std::string to_text(const CostResult& result);
std::string to_csv(const CostResult& result);
nlohmann::json to_json(const CostResult& result);

}  // namespace halfspace::compare
