#include "compare/cost_truth.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "compare/capture.h"
#include "compare/html.h"
#include "compare/libraries.h"

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;

std::string when_written(const fs::path& path) {
  return std::to_string(fs::last_write_time(path).time_since_epoch().count());
}

// What a kept truth depends on.
std::string key_of(const CostOptions& options, const SceneGroup& group) {
  const fs::path oracle = oracle_folder("libOSMesa.so.8", options.folders.oracle) / "libOSMesa.so.8";
  return oracle.string() + " " + when_written(oracle) + " " +
         when_written(house_program(group.program.name)) + "\n";
}

std::string first_line(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line + "\n";
}

std::string second_line(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::getline(file, line);
  return line;
}

// The folder's name has the scene, the paint and the size.
fs::path truth_folder(const CostOptions& options, const SceneGroup& group, size_t index,
                      const std::string& paint) {
  return options.out / "truth" /
         (group.program.name + "_" + group.arguments[index] + "_" + paint + "_" +
          std::to_string(options.width) + "x" + std::to_string(options.height));
}

// Draws one frame; its files are in `folder` then, and the renderer's name behind the key in key.txt.
void draw_truth(const CostOptions& options, const SceneGroup& group, size_t index, const std::string& paint,
                const fs::path& folder) {
  fs::remove_all(folder);
  fs::create_directories(folder);
  DrawJob job;
  job.program = group.program;
  job.setting = truth_setting();
  job.folders = options.folders;
  job.scenes = {group.arguments[index]};
  job.paint = paint;
  job.width = options.width;
  job.height = options.height;
  job.out = folder;
  job.environment = {{"HALFSPACE_TRUTH", fs::absolute(folder).string()}};
  const DrawnScenes drawn = draw_scenes(job);
  write_text(folder / "key.txt", key_of(options, group) + drawn.renderer + "\n");
}

}  // namespace

fs::path last_truth_file(const fs::path& folder) {
  const std::vector<fs::path> files = captured_frames(folder, "truth");
  if (files.empty())
    throw std::runtime_error("the oracle left no picture in " + folder.string() +
                             "; its words are in log.txt there");
  return files.back();
}

PaintedTruths::PaintedTruths(const CostOptions& options, const SceneGroup& group, size_t index,
                             const Progress& progress) {
  for (const std::string& paint : paints_of(group.program)) {
    const fs::path folder = truth_folder(options, group, index, paint);
    if (first_line(folder / "key.txt") != key_of(options, group)) {
      progress("truth of " + group.labels[index] + " (" + paint + ")");
      draw_truth(options, group, index, paint, folder);
    }
    renderer_ = second_line(folder / "key.txt");
    truths_.emplace(paint, load_truth(last_truth_file(folder)));
  }
}

TruthError PaintedTruths::error_of(const std::map<std::string, fs::path>& pictures) const {
  OwnerFlags same_owner;
  if (truths_.contains("owners"))
    same_owner = same_owner_flags(load_image(pictures.at("owners")), truths_.at("owners"));
  TruthError error = compare::error_of(load_image(pictures.at("scene")), truths_.at("scene"), same_owner);
  if (truths_.contains("texels"))
    error.texels = texel_offsets(load_image(pictures.at("texels")), truths_.at("texels"), same_owner);
  return error;
}

}  // namespace halfspace::compare
