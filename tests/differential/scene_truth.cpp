// Holds the eight scenes, as the libraries draw them, against the true pictures. Exit status: 0 all promises
// are kept, 1 some are broken, 2 it could not be found out.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>

#include "ref_app/scenes.h"
#include "tests/differential/drawings.h"
#include "tests/differential/scene_verdict.h"

namespace halfspace::differential {
namespace {

using compare::Renderer;

struct Options {
  DrawJob job;
  std::string json;
  Positions positions = Positions::snapped;
};

// Returns true to go on; otherwise the program ends with `exit_code`.
bool parse(int argc, char** argv, Options& options, int& exit_code) {
  CLI::App app(
      "Holds the eight scenes, as the libraries draw them, against a truth computed in long double.");
  std::string out = "out/truth";
  bool ideal = false;
  app.add_option("--scene", options.job.scenes, "Only this scene, 1 to 8; may be given again")
      ->check(CLI::Range(1, ref_app::kSceneCount));
  app.add_option("--width", options.job.width, "Picture width")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app.add_option("--height", options.job.height, "Picture height")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app.add_option("--out", out, "Folder for the pictures")->capture_default_str();
  app.add_option("--json", options.json, "Write the figures to this file");
  app.add_flag("--ideal", ideal, "Colours belong to the corners as they are before snapping to 1/256 px");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& refusal) {
    exit_code = app.exit(refusal) == 0 ? 0 : 2;
    return false;
  }
  if (options.job.scenes.empty()) options.job.scenes = {1, 2, 3, 4, 5, 6, 7, 8};
  options.job.out = std::filesystem::absolute(out);
  if (ideal) options.positions = Positions::ideal;
  return true;
}

struct AllDrawings {
  Drawings ours, ours_draft;
  std::optional<Drawings> osmesa, osmesa_float;
};

AllDrawings draw_all(const DrawJob& job) {
  AllDrawings all;
  all.ours = draw_scenes(job, Renderer::ours, true);
  all.ours_draft = draw_scenes(job, Renderer::ours_draft, true);
  if (const auto reason = why_no_osmesa()) {
    std::printf("OSMesa's rows are left out: %s\n", reason->c_str());
    return all;
  }
  all.osmesa = draw_scenes(job, Renderer::osmesa, true);
  all.osmesa_float = draw_scenes(job, Renderer::osmesa_float, true);
  std::printf("%s beside %s\n\n", all.ours.gl_renderer.c_str(), all.osmesa->gl_renderer.c_str());
  return all;
}

SceneVerdict verdict_on(int scene, const AllDrawings& all, const Options& options) {
  const auto begin = std::chrono::steady_clock::now();
  const Truth truth =
      true_picture(record_scene(scene, options.job.width, options.job.height), options.positions);
  SceneVerdict verdict;
  verdict.scene = scene;
  verdict.truth_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  for (const Owner owner : truth.owner) verdict.owned += owner != 0;
  const Drawn &ours = all.ours.scenes.at(scene), &draft = all.ours_draft.scenes.at(scene);
  verdict.ours = judge(truth, ours);
  verdict.ours_draft = judge(truth, draft);
  if (all.osmesa && all.osmesa_float) {
    const Drawn &osmesa = all.osmesa->scenes.at(scene), &filtered = all.osmesa_float->scenes.at(scene);
    verdict.osmesa = judge(truth, osmesa);
    verdict.osmesa_float = judge(truth, filtered);
    verdict.standard_to_float = between(truth, ours.picture, filtered.picture);
    verdict.draft_to_default = between(truth, draft.picture, osmesa.picture);
  }
  return verdict;
}

int run(const Options& options) {
  const AllDrawings all = draw_all(options.job);
  std::vector<SceneVerdict> verdicts;
  for (const int scene : options.job.scenes) verdicts.push_back(verdict_on(scene, all, options));
  std::printf("%s", to_text(verdicts).c_str());
  if (!options.json.empty()) {
    std::ofstream file(options.json);
    file << to_json(verdicts).dump(1) << "\n";
    file.close();
    if (!file) throw std::runtime_error("cannot write " + options.json);
  }
  bool good = true;
  for (const SceneVerdict& verdict : verdicts) {
    for (const std::string& words : verdict.broken()) {
      std::printf("BROKEN  %s\n", words.c_str());
      good = false;
    }
  }
  return good ? 0 : 1;
}

}  // namespace
}  // namespace halfspace::differential

int main(int argc, char** argv) {
  try {
    halfspace::differential::Options options;
    int exit_code = 0;
    if (!halfspace::differential::parse(argc, argv, options, exit_code)) return exit_code;
    return halfspace::differential::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scene_truth: %s\n", error.what());
    return 2;
  }
}
