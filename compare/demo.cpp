#include "compare/demo.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "compare/difference_text.h"

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;

const char* folder_name(Renderer renderer) {
  switch (renderer) {
    case Renderer::ours:
      return "ours";
    case Renderer::osmesa:
      return "osmesa";
    case Renderer::osmesa_float:
      return "osmesa_float";
  }
  return "";
}

SceneJob job_of(const DemoOptions& options, Renderer renderer) {
  SceneJob job;
  job.renderer = renderer;
  job.scenes = options.scenes;
  job.frames = options.frames;
  job.width = options.width;
  job.height = options.height;
  job.out = options.out / folder_name(renderer);
  job.library = options.library;
  return job;
}

const SceneTime& scene_of(const SceneResult& result, int scene) {
  const auto found = std::find_if(result.scenes.begin(), result.scenes.end(),
                                  [scene](const SceneTime& time) { return time.scene == scene; });
  if (found == result.scenes.end())
    throw std::runtime_error("scene " + std::to_string(scene) + " is missing from the result of " +
                             result.renderer);
  return *found;
}

// OSMesa's picture is the reference, so its edges count.
Difference difference_to(const SceneTime& reference, const Image& ours) {
  const Image theirs = load_image(reference.picture);
  return compare_images(theirs, ours, find_edges(theirs));
}

void compare_scenes(Demo& demo) {
  for (const SceneTime& time : demo.ours.scenes) {
    DemoScene scene{time, scene_of(demo.osmesa, time.scene), scene_of(demo.osmesa_float, time.scene), {}, {}};
    const Image ours = load_image(time.picture);
    scene.to_osmesa = difference_to(scene.osmesa, ours);
    scene.to_float = difference_to(scene.osmesa_float, ours);
    demo.scenes.push_back(std::move(scene));
  }
}

nlohmann::json to_json(const DemoScene& scene) {
  return {{"scene", scene.ours.scene},
          {"name", scene.ours.name},
          {"ours_ms", scene.ours.median_ms},
          {"osmesa_ms", scene.osmesa.median_ms},
          {"osmesa_float_ms", scene.osmesa_float.median_ms},
          {"to_osmesa", to_json(scene.to_osmesa)},
          {"to_osmesa_float", to_json(scene.to_float)},
          {"good", scene.good()}};
}

}  // namespace

bool DemoScene::good() const {
  return to_float.differing_percent() <= kMostDifferingPercent &&
         to_float.max_interior <= kMostInteriorLevels;
}

Demo run_demo(const DemoOptions& options, const std::function<void(const std::string&)>& progress) {
  Demo demo;
  for (const auto& [renderer, result] : {std::pair{Renderer::ours, &demo.ours},
                                         {Renderer::osmesa, &demo.osmesa},
                                         {Renderer::osmesa_float, &demo.osmesa_float}}) {
    progress(std::string("drawing with ") + renderer_name(renderer));
    *result = run_scenes(job_of(options, renderer));
  }
  progress("comparing");
  compare_scenes(demo);
  return demo;
}

Demo load_demo(const fs::path& out) {
  Demo demo;
  demo.ours = read_scene_result(out / folder_name(Renderer::ours) / "result.json");
  demo.osmesa = read_scene_result(out / folder_name(Renderer::osmesa) / "result.json");
  demo.osmesa_float = read_scene_result(out / folder_name(Renderer::osmesa_float) / "result.json");
  compare_scenes(demo);
  return demo;
}

std::string to_text(const Demo& demo) {
  std::string text = "ours:   " + demo.ours.renderer + ", " + demo.ours.version +
                     "\ntheirs: " + demo.osmesa.renderer + ", " + demo.osmesa.version + "\n\n";
  char line[300];
  std::snprintf(line, sizeof line, "%-24s %10s %10s %7s   %-30s %s\n", "scene", "ours", "OSMesa", "ratio",
                "pixels off OSMesa's float filter", "off its 8-bit filter");
  text += line;
  for (const DemoScene& scene : demo.scenes) {
    const std::string off_float = count_of(scene.to_float.differing, scene.to_float.pixels) + ", inside by " +
                                  short_number(scene.to_float.max_interior);
    std::snprintf(line, sizeof line, "%-24s %7.2f ms %7.2f ms %7.3f   %s %s, %s %%\n",
                  (std::to_string(scene.ours.scene) + " " + scene.ours.name).c_str(), scene.ours.median_ms,
                  scene.osmesa.median_ms, scene.ours.median_ms / scene.osmesa.median_ms,
                  scene.good() ? "ok  " : "MORE", off_float.c_str(),
                  short_number(scene.to_osmesa.differing_percent()).c_str());
    text += line;
  }
  return text;
}

nlohmann::json to_json(const Demo& demo) {
  nlohmann::json scenes = nlohmann::json::array();
  for (const DemoScene& scene : demo.scenes) scenes.push_back(to_json(scene));
  return {{"ours", {{"renderer", demo.ours.renderer}, {"version", demo.ours.version}}},
          {"osmesa", {{"renderer", demo.osmesa.renderer}, {"version", demo.osmesa.version}}},
          {"scenes", scenes}};
}

}  // namespace halfspace::compare
