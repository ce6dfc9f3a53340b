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
};

// Returns true to go on; otherwise the program ends with `exit_code`.
bool parse(int argc, char** argv, Options& options, int& exit_code) {
  CLI::App app(
      "Holds the eight scenes, as the libraries draw them, against a truth computed in long double.");
  std::string out = "out/truth";
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
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& refusal) {
    exit_code = app.exit(refusal) == 0 ? 0 : 2;
    return false;
  }
  if (options.job.scenes.empty()) options.job.scenes = {1, 2, 3, 4, 5, 6, 7, 8};
  options.job.out = std::filesystem::absolute(out);
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

Truths truths_by(const Recording& recording, Filter filter) {
  return {true_picture(recording, {Positions::snapped, filter}),
          true_picture(recording, {Positions::ideal, filter})};
}

SceneVerdict verdict_on(int scene, const AllDrawings& all, const DrawJob& job) {
  const auto begin = std::chrono::steady_clock::now();
  const Recording recording = record_scene(scene, job.width, job.height);
  const Truths exact = truths_by(recording, Filter::exact),
               eight_bit = truths_by(recording, Filter::eight_bit);
  SceneVerdict verdict;
  verdict.scene = scene;
  verdict.truth_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto standing = [&](const Truths& truths, const Drawings& drawings) -> Standing {
    const Drawn& drawn = drawings.scenes.at(scene);
    return {judge(recording, truths.snapped, drawn), judge(recording, truths.ideal, drawn)};
  };
  const auto disagreement = [&](const Truths& truths, const Drawings& ours, const Drawings& theirs) {
    return between(truths, ours.scenes.at(scene), theirs.scenes.at(scene));
  };
  verdict.ours = standing(exact, all.ours);
  verdict.ours_draft = standing(eight_bit, all.ours_draft);
  if (all.osmesa && all.osmesa_float) {
    verdict.osmesa_float = standing(exact, *all.osmesa_float);
    verdict.osmesa = standing(eight_bit, *all.osmesa);
    verdict.standard_to_float = disagreement(exact, all.ours, *all.osmesa_float);
    verdict.draft_to_default = disagreement(eight_bit, all.ours_draft, *all.osmesa);
  }
  return verdict;
}

int run(const Options& options) {
  const AllDrawings all = draw_all(options.job);
  std::vector<SceneVerdict> verdicts;
  for (const int scene : options.job.scenes) verdicts.push_back(verdict_on(scene, all, options.job));
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
