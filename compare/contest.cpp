#include "compare/contest.h"

#include <algorithm>
#include <filesystem>

#include "compare/libraries.h"

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kLibrary = "libOSMesa.so.8";
constexpr double kBatchMs = 30;  // about so long a batch: shorter than a machine keeps its speed

ChildCommand command_for(const std::string& library, const std::vector<EnvironmentVariable>& environment,
                         const std::vector<int>& cores) {
  ChildCommand command;
  command.arguments = {house_program("workloads").string(), "--serve", "--library", library};
  command.environment = environment;
  command.cores = cores;
  return command;
}

std::string library_at(const fs::path& place) {
  for (const fs::path& path : {place, place / kLibrary, place / "lib" / kLibrary})
    if (fs::is_regular_file(path)) return fs::canonical(path).string();
  throw NotFound("no " + std::string(kLibrary) + " in " + place.string());
}

std::vector<EnvironmentVariable> our_environment(int threads, bool draft) {
  return {{"HALFSPACE_THREADS", std::to_string(threads)},
          {"HALFSPACE_ACCURACY", draft ? "draft" : "standard"}};
}

bool is_ours(const Drawer& drawer) { return drawer.renderer.starts_with("Halfspace"); }

struct Samples {
  std::vector<double> cpu_ms, wall_ms;

  void add(const Json& answer, int frames) {
    cpu_ms.push_back(answer.at("cpu_ms").get<double>() / frames);
    wall_ms.push_back(answer.at("wall_ms").get<double>() / frames);
  }
  FrameTime summary() const { return {summarize(cpu_ms), summarize(wall_ms)}; }
};

// How many frames make a batch, after one frame that fills the caches and lets llvmpipe compile.
int batch_of(Contestant& contestant) {
  contestant.order("run 1");
  const double frame_ms = contestant.order("run 1").at("wall_ms");
  return std::clamp(static_cast<int>(kBatchMs / std::max(frame_ms, 0.01)), 1, 2000);
}

}  // namespace

Contestant::Contestant(const std::string& library, const std::vector<EnvironmentVariable>& environment,
                       const std::vector<int>& cores)
    : dialogue_(command_for(library, environment, cores)) {}

Json Contestant::order(const std::string& line) {
  Json answer = Json::parse(dialogue_.ask(line));
  if (answer.contains("error")) throw std::runtime_error(line + ": " + answer["error"].get<std::string>());
  return answer;
}

std::unique_ptr<Contestant> start_halfspace(const HalfspaceSetting& setting, const std::vector<int>& cores) {
  std::vector<EnvironmentVariable> environment = our_environment(setting.threads, setting.draft);
  environment.emplace_back("HALFSPACE_TRACE", setting.trace);
  return std::make_unique<Contestant>((library_folder(kLibrary, setting.folder) / kLibrary).string(),
                                      environment, cores);
}

std::unique_ptr<Contestant> start_other_build(const std::string& place, bool draft,
                                              const std::vector<int>& cores) {
  return std::make_unique<Contestant>(library_at(place), our_environment(1, draft), cores);
}

std::unique_ptr<Contestant> start_mesa(bool softpipe, const std::vector<int>& cores) {
  // llvmpipe counts helpers beside the calling thread: none of them is one thread.
  const std::vector<EnvironmentVariable> environment{{"GALLIUM_DRIVER", softpipe ? "softpipe" : "llvmpipe"},
                                                     {"LP_NUM_THREADS", "0"}};
  // By name: the dynamic linker's, which is the system's.
  return std::make_unique<Contestant>(kLibrary, environment, cores);
}

Drawer require_halfspace(const Json& opened) {
  const Drawer drawer{opened.at("renderer"), opened.at("version")};
  if (!is_ours(drawer)) throw std::runtime_error("asked for Halfspace, but \"" + drawer.renderer + "\" drew");
  return drawer;
}

Drawer require_mesa(const Json& opened) {
  const Drawer drawer{opened.at("renderer"), opened.at("version")};
  if (is_ours(drawer))
    throw std::runtime_error("asked for Mesa, but \"" + drawer.renderer +
                             "\" drew; is an LD_LIBRARY_PATH in the way?");
  return drawer;
}

Turns take_turns(Contestant& first, Contestant& second, int rounds) {
  const int first_frames = batch_of(first), second_frames = batch_of(second);
  Samples first_times, second_times;
  const auto run_first = [&] {
    first_times.add(first.order("run " + std::to_string(first_frames)), first_frames);
  };
  const auto run_second = [&] {
    second_times.add(second.order("run " + std::to_string(second_frames)), second_frames);
  };
  for (int round = 0; round < rounds; ++round) {
    if (round % 2 == 0) run_first();
    run_second();
    if (round % 2 != 0) run_first();
  }
  return {first_times.summary(), second_times.summary(),
          paired_ratio(second_times.cpu_ms, first_times.cpu_ms),
          paired_ratio(second_times.wall_ms, first_times.wall_ms)};
}

}  // namespace halfspace::compare
