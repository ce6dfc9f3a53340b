#include "compare/scene_run.h"

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "compare/libraries.h"

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "ref_app_osmesa";
constexpr const char* kOurLibrary = "libOSMesa.so.8";

bool is_ours(Renderer renderer) { return renderer == Renderer::ours || renderer == Renderer::ours_draft; }

std::vector<EnvironmentVariable> environment_of(const SceneJob& job) {
  if (is_ours(job.renderer)) {
    std::vector<EnvironmentVariable> ours{library_path_with(library_folder(kOurLibrary, job.library))};
    ours.emplace_back("HALFSPACE_ACCURACY", job.renderer == Renderer::ours_draft ? "filter=draft" : "standard");
    if (job.threads > 0) ours.emplace_back("HALFSPACE_THREADS", std::to_string(job.threads));
    return ours;
  }
  std::vector<EnvironmentVariable> theirs{{"GALLIUM_DRIVER", "llvmpipe"}};
  // llvmpipe counts helpers beside the calling thread: none of them is one thread.
  if (job.threads > 0)
    theirs.emplace_back("LP_NUM_THREADS", std::to_string(job.threads == 1 ? 0 : job.threads));
  theirs.emplace_back("GALLIVM_PERF", job.renderer == Renderer::osmesa_float ? "no_aos_sampling" : "");
  return theirs;
}

ChildCommand command_of(const SceneJob& job, const fs::path& json) {
  ChildCommand command;
  command.arguments = {house_program(kProgram).string(),
                       "--backend",
                       "osmesa",
                       "--size",
                       std::to_string(job.width) + "x" + std::to_string(job.height),
                       "--frames",
                       std::to_string(job.frames),
                       "--paint",
                       job.paint,
                       "--out",
                       job.out.string(),
                       "--json",
                       json.string()};
  if (job.pictures)
    command.arguments.insert(command.arguments.end(), {"--format", "png"});
  else
    command.arguments.push_back("--no-pictures");
  for (int scene : job.scenes) {
    command.arguments.push_back("--scene");
    command.arguments.push_back(std::to_string(scene));
  }
  command.environment = environment_of(job);
  command.cores = job.cores;
  command.output = job.out / "log.txt";
  return command;
}

// ref_app measures the time to its first picture from here.
EnvironmentVariable start_now() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();  // CLOCK_MONOTONIC
  return {"REF_APP_START_NS", std::to_string(std::chrono::nanoseconds(now).count())};
}

std::string whole_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void require_renderer(const SceneJob& job, const SceneResult& result) {
  if (result.renderer.starts_with("Halfspace") == is_ours(job.renderer)) return;
  throw std::runtime_error(std::string("asked for ") + renderer_name(job.renderer) + ", but \"" +
                           result.renderer + "\" drew; is an LD_LIBRARY_PATH or LD_PRELOAD in the way?");
}

SceneTime scene_time(const nlohmann::json& entry, const fs::path& folder) {
  SceneTime time;
  time.scene = entry.at("scene").get<int>();
  time.name = entry.value("name", "");
  time.first_ms = entry.at("first_ms").get<double>();
  time.median_ms = entry.at("median_ms").get<double>();
  time.frames_ms = entry.value("frame_ms", std::vector<double>{});
  // A file name, beside the result; null when none was saved.
  if (const nlohmann::json& picture = entry.at("picture"); picture.is_string())
    time.picture = folder / fs::path(picture.get<std::string>()).filename();
  return time;
}

}  // namespace

const char* renderer_name(Renderer renderer) {
  switch (renderer) {
    case Renderer::ours:
      return "Halfspace";
    case Renderer::ours_draft:
      return "Halfspace, draft";
    case Renderer::osmesa:
      return "OSMesa";
    case Renderer::osmesa_float:
      return "OSMesa, float filter";
  }
  return "";
}

SceneResult run_scenes(const SceneJob& job) {
  fs::create_directories(job.out);
  const fs::path json = job.out / "result.json";
  fs::remove(json);
  ChildCommand command = command_of(job, json);
  command.environment.push_back(start_now());
  const ChildResult child = run_child(command);
  if (child.exit_code != 0)
    throw std::runtime_error(std::string(renderer_name(job.renderer)) + ": " + kProgram +
                             " ended with status " + std::to_string(child.exit_code) + ":\n" +
                             whole_file(command.output));
  SceneResult result = read_scene_result(json);
  result.process_seconds = child.seconds;
  require_renderer(job, result);
  return result;
}

SceneResult read_scene_result(const fs::path& path) {
  try {
    const nlohmann::json json = nlohmann::json::parse(whole_file(path));
    SceneResult result;
    result.renderer = json.at("gl_renderer").get<std::string>();
    result.version = json.at("gl_version").get<std::string>();
    result.first_picture_ms = json.at("start_to_first_picture_ms").get<double>();
    result.peak_kib = json.at("peak_rss_kib").get<long>();
    for (const nlohmann::json& entry : json.at("scenes"))
      result.scenes.push_back(scene_time(entry, path.parent_path()));
    return result;
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(path.string() + ": is not what ref_app --json writes: " + error.what());
  }
}

}  // namespace halfspace::compare
