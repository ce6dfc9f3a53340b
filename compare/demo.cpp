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
    case Renderer::ours_draft:
      return "ours_draft";
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

// What each pixel shows is one frame's work.
SceneJob owners_job_of(const DemoOptions& options, Renderer renderer) {
  SceneJob job = job_of(options, renderer);
  job.frames = 0;
  job.paint = "owners";
  job.out /= job.paint;
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

Difference difference_to(const SceneTime& reference, const SceneTime& ours, const EdgeMask& edges) {
  return compare_images(load_image(reference.picture), load_image(ours.picture), edges);
}

void compare_scenes(Demo& demo) {
  for (const SceneTime& time : demo.ours.scenes) {
    DemoScene scene{time,
                    scene_of(demo.ours_draft, time.scene),
                    scene_of(demo.osmesa, time.scene),
                    scene_of(demo.osmesa_float, time.scene),
                    {},
                    {}};
    const EdgeMask edges = edges_of_coverage(load_image(scene_of(demo.our_owners, time.scene).picture),
                                             load_image(scene_of(demo.osmesa_owners, time.scene).picture));
    scene.standard = difference_to(scene.osmesa_float, scene.ours, edges);
    scene.draft = difference_to(scene.osmesa, scene.ours_draft, edges);
    demo.scenes.push_back(std::move(scene));
  }
}

std::string in_a_cell(const Difference& d) {
  return (keeps_promise(d) ? "ok   " : "MORE ") + short_number(d.differing_percent()) + " %, inside " +
         short_number(d.max_interior);
}

nlohmann::json to_json(const DemoScene& scene) {
  return {{"scene", scene.ours.scene},
          {"name", scene.ours.name},
          {"ours_ms", scene.ours.median_ms},
          {"osmesa_ms", scene.osmesa.median_ms},
          {"osmesa_float_ms", scene.osmesa_float.median_ms},
          {"standard_to_osmesa_float", to_json(scene.standard)},
          {"draft_to_osmesa", to_json(scene.draft)},
          {"other_triangle", scene.standard.edge_pixels},
          {"good", scene.good()}};
}

}  // namespace

bool keeps_promise(const Difference& difference) {
  return difference.differing_percent() <= kMostDifferingPercent &&
         difference.max_interior <= kMostInteriorLevels;
}

bool DemoScene::good() const { return keeps_promise(standard) && keeps_promise(draft); }

Demo run_demo(const DemoOptions& options, const std::function<void(const std::string&)>& progress) {
  Demo demo;
  for (const auto& [renderer, result] : {std::pair{Renderer::ours, &demo.ours},
                                         {Renderer::ours_draft, &demo.ours_draft},
                                         {Renderer::osmesa, &demo.osmesa},
                                         {Renderer::osmesa_float, &demo.osmesa_float}}) {
    progress(std::string("drawing with ") + renderer_name(renderer));
    *result = run_scenes(job_of(options, renderer));
  }
  progress("drawing which triangle each pixel shows");
  demo.our_owners = run_scenes(owners_job_of(options, Renderer::ours));
  demo.osmesa_owners = run_scenes(owners_job_of(options, Renderer::osmesa));
  progress("comparing");
  compare_scenes(demo);
  return demo;
}

Demo load_demo(const fs::path& out) {
  Demo demo;
  demo.ours = read_scene_result(out / folder_name(Renderer::ours) / "result.json");
  demo.ours_draft = read_scene_result(out / folder_name(Renderer::ours_draft) / "result.json");
  demo.osmesa = read_scene_result(out / folder_name(Renderer::osmesa) / "result.json");
  demo.osmesa_float = read_scene_result(out / folder_name(Renderer::osmesa_float) / "result.json");
  demo.our_owners = read_scene_result(out / folder_name(Renderer::ours) / "owners/result.json");
  demo.osmesa_owners = read_scene_result(out / folder_name(Renderer::osmesa) / "owners/result.json");
  compare_scenes(demo);
  return demo;
}

std::string to_text(const Demo& demo) {
  std::string text = "ours:   " + demo.ours.renderer + ", " + demo.ours.version +
                     "\ntheirs: " + demo.osmesa.renderer + ", " + demo.osmesa.version + "\n\n";
  char line[300];
  std::snprintf(line, sizeof line, "%-24s %10s %10s %7s   %-26s %-26s %s\n", "scene", "ours", "OSMesa",
                "ratio", "standard off float filter", "draft off 8-bit filter", "other triangle");
  text += line;
  for (const DemoScene& scene : demo.scenes) {
    std::snprintf(line, sizeof line, "%-24s %7.2f ms %7.2f ms %7.3f   %-26s %-26s %llu pixels\n",
                  (std::to_string(scene.ours.scene) + " " + scene.ours.name).c_str(), scene.ours.median_ms,
                  scene.osmesa.median_ms, scene.ours.median_ms / scene.osmesa.median_ms,
                  in_a_cell(scene.standard).c_str(), in_a_cell(scene.draft).c_str(),
                  static_cast<unsigned long long>(scene.standard.edge_pixels));
    text += line;
  }
  return text + "\nok: at most " + short_number(kMostDifferingPercent) +
         " % of the pixels differ, none inside by more than " + short_number(kMostInteriorLevels) +
         " level. Other triangle: the\ntwo show another one there (who is right: "
         "build/release/differential/scene_truth); inside "
         "is everywhere else.\n";
}

nlohmann::json to_json(const Demo& demo) {
  nlohmann::json scenes = nlohmann::json::array();
  for (const DemoScene& scene : demo.scenes) scenes.push_back(to_json(scene));
  return {{"ours", {{"renderer", demo.ours.renderer}, {"version", demo.ours.version}}},
          {"osmesa", {{"renderer", demo.osmesa.renderer}, {"version", demo.osmesa.version}}},
          {"scenes", scenes}};
}

}  // namespace halfspace::compare
