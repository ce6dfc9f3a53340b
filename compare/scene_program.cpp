#include "compare/scene_program.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "compare/libraries.h"

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLibrary = "libOSMesa.so.8";

std::string whole_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

ChildCommand command_of(const DrawJob& job, const fs::path& json) {
  ChildCommand command;
  command.arguments = {house_program(job.program.name).string()};
  const auto add = [&command](std::initializer_list<std::string> words) {
    command.arguments.insert(command.arguments.end(), words);
  };
  add({"--size", std::to_string(job.width) + "x" + std::to_string(job.height), "--frames",
       std::to_string(job.frames), "--json", json.string()});
  if (job.pictures) add({"--out", job.out.string()});
  if (job.program.chooses_format && job.pictures) add({"--format", "png"});
  if (job.program.chooses_format && !job.pictures) add({"--no-pictures"});
  if (job.program.paints) add({"--paint", job.paint});
  for (const std::string& scene : job.scenes) add({job.program.scene_option, scene});
  command.environment = environment_of(job.setting, job.folders, kLibrary);
  command.environment.insert(command.environment.end(), job.environment.begin(), job.environment.end());
  command.cores = job.cores;
  command.output = job.out / "log.txt";
  return command;
}

void require_success(const ChildCommand& command, const std::string& who) {
  const ChildResult child = run_child(command);
  if (child.exit_code == 0) return;
  throw std::runtime_error(who + ": " + fs::path(command.arguments.front()).filename().string() +
                           " ended with status " + std::to_string(child.exit_code) + ":\n" +
                           whole_file(command.output));
}

DrawnScene drawn_scene(const nlohmann::json& entry, const fs::path& folder) {
  DrawnScene scene;
  scene.name = entry.value("name", "");
  scene.cpu_ms = entry.at("frame_cpu_ms").get<std::vector<double>>();
  if (const auto picture = entry.find("picture"); picture != entry.end() && picture->is_string())
    scene.picture = folder / fs::path(picture->get<std::string>()).filename();
  return scene;
}

DrawnScenes read_report(const fs::path& path) {
  try {
    const nlohmann::json json = nlohmann::json::parse(whole_file(path));
    DrawnScenes drawn{
        json.at("gl_renderer").get<std::string>(), json.at("gl_version").get<std::string>(), {}};
    for (const nlohmann::json& entry : json.at("scenes"))
      drawn.scenes.push_back(drawn_scene(entry, path.parent_path()));
    return drawn;
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(path.string() + ": is not a report of scenes: " + error.what());
  }
}

}  // namespace

DrawnScenes draw_scenes(const DrawJob& job) {
  fs::create_directories(job.out);
  const fs::path json = job.out / "result.json";
  fs::remove(json);
  require_success(command_of(job, json), job.setting.name);
  DrawnScenes drawn = read_report(json);
  if (!is_renderer_of(job.setting, drawn.renderer))
    throw std::runtime_error("asked for " + job.setting.name + ", but \"" + drawn.renderer +
                             "\" drew; is an LD_LIBRARY_PATH or LD_PRELOAD in the way?");
  if (drawn.scenes.size() != job.scenes.size())
    throw std::runtime_error(json.string() + ": has " + std::to_string(drawn.scenes.size()) +
                             " scenes in place of " + std::to_string(job.scenes.size()));
  return drawn;
}

std::vector<std::string> listed_lines(const SceneProgram& program) {
  ChildCommand command;
  command.arguments = {house_program(program.name).string(), "--list"};
  command.output = fs::temp_directory_path() / ("halfspace-list-" + std::to_string(getpid()) + ".txt");
  require_success(command, "list of scenes");
  std::istringstream text(whole_file(command.output));
  fs::remove(command.output);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

std::vector<std::string> listed_scenes(const SceneProgram& program) {
  std::vector<std::string> names;
  for (const std::string& line : listed_lines(program))
    names.push_back(line.substr(0, line.find_first_of("\t ")));
  return names;
}

}  // namespace halfspace::compare
