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

// What the standard level promises against OSMesa's float filter, and the draft level against its 8-bit
// filter.
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
  SceneTime ours, ours_draft, osmesa, osmesa_float;
  // Edges, in these: where ours and OSMesa show another triangle.
  Difference standard;  // ours to osmesa_float
  Difference draft;     // ours_draft to osmesa
  bool good() const;
};

struct Demo {
  SceneResult ours, ours_draft, osmesa, osmesa_float;
  SceneResult our_owners, osmesa_owners;  // pictures of which triangle drew each pixel
  std::vector<DemoScene> scenes;
};

bool keeps_promise(const Difference& difference);

// The results of the renderers are left in `out`: ours/, ours_draft/, osmesa/, osmesa_float/, and ours/owners/ and
// osmesa/owners/.
Demo run_demo(const DemoOptions& options, const std::function<void(const std::string&)>& progress);
// The same from results of before, without drawing anything.
Demo load_demo(const std::filesystem::path& out);

std::string to_text(const Demo& demo);
nlohmann::json to_json(const Demo& demo);
std::string demo_report(const Demo& demo, double gain);

}  // namespace halfspace::compare
