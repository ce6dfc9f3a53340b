// The eight scenes drawn by us and by OSMesa, compared: what `halfspace demo` shows.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/difference.h"
#include "compare/scene_run.h"

namespace halfspace::compare {

// What the standard level promises against OSMesa's float filter.
constexpr double kMostDifferingPercent = 0.1;
constexpr double kMostInteriorLevels = 1;

struct DemoOptions {
  std::vector<int> scenes;  // empty: all eight
  int frames = 5;
  int width = 1024, height = 1024;
  std::optional<std::string> library;
  std::filesystem::path out = "out/demo";
  double gain = 64;
};

struct DemoScene {
  SceneTime ours, osmesa, osmesa_float;
  Difference to_osmesa, to_float;
  bool good() const;
};

struct Demo {
  SceneResult ours, osmesa, osmesa_float;
  std::vector<DemoScene> scenes;
};

// The result of each renderer as its folder ours/, osmesa/ and osmesa_float/ in `out` holds it.
Demo run_demo(const DemoOptions& options, const std::function<void(const std::string&)>& progress);
// The same from results of before, without drawing anything.
Demo load_demo(const std::filesystem::path& out);

std::string to_text(const Demo& demo);
nlohmann::json to_json(const Demo& demo);
std::string demo_report(const Demo& demo, double gain);

}  // namespace halfspace::compare
