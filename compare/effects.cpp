#include "compare/effects.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "compare/cost_scenes.h"
#include "compare/libraries.h"
#include "compare/processor.h"

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIdle = "idle";
constexpr const char* kEverything = "everything";
constexpr const char* kLight = "light";

// By what the names of an effect's stages are known; raster/fragment/stages.def has them all. Light has none:
// it belongs to the vertices.
struct EffectStages {
  const char* effect;
  std::array<const char*, 2> parts;  // of the names; the second may be null
};
constexpr EffectStages kStages[] = {
    {"depth", {"depth_", nullptr}},
    {"texture", {"coord_", "sample_"}},
    {"perspective", {"_perspective", nullptr}},
    {"filter", {"sample_linear", "sample_levels"}},
    {"mipmap", {"lambda", "sample_levels"}},
    {"fog", {"fog_", nullptr}},
    {"blend", {"blend_", nullptr}},
    {"stencil", {"stencil_", nullptr}},
    {"alpha_test", {"alpha_test", nullptr}},
};

bool belongs_to(const EffectStages& effect, const std::string& stage) {
  return std::any_of(effect.parts.begin(), effect.parts.end(), [&stage](const char* part) {
    return part != nullptr && stage.find(part) != std::string::npos;
  });
}

std::string whole_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// The number that ends right before `words`, as in "12 draws"; 0 if there is none.
uint64_t number_before(const std::string& line, const char* words) {
  const size_t end = line.find(std::string(" ") + words);
  if (end == std::string::npos) return 0;
  const size_t start = line.find_last_not_of("0123456789", end == 0 ? 0 : end - 1) + 1;
  return start < end ? std::stoull(line.substr(start, end - start)) : 0;
}

Setting metered_setting() {
  Setting setting = standard_setting();
  setting.environment.emplace_back("HALFSPACE_STATS", "1");
  return setting;
}

class EffectsRun {
 public:
  EffectsRun(const CostOptions& options, const Progress& progress) : options_(options), progress_(progress) {
    for (const std::string& line : listed_lines(effect_scenes())) {
      const std::string name = line.substr(0, line.find('\t'));
      if (name != kEverything) names_.push_back(name);
      if (name != kEverything)
        descriptions_.push_back(line.substr(std::min(line.find('\t') + 1, line.size())));
    }
  }

  EffectsResult measure(bool instructions) {
    result_.processor = processor_name();
    result_.width = options_.width, result_.height = options_.height, result_.rounds = options_.rounds;
    std::vector<EffectStep> steps;
    for (size_t i = 0; i < names_.size(); ++i)
      steps.push_back({names_[i], descriptions_[i], {}, {}, {}, {}, {}});
    time(steps);
    for (EffectStep& step : steps) {
      progress_("what the stages do: " + step.name);
      step.statistics = statistics_of(draw_one(step.name, metered_setting()));
    }
    if (instructions)
      for (EffectStep& step : steps) step.instructions = count_instructions(step.name);
    take(std::move(steps));
    find_stages(result_);
    return result_;
  }

 private:
  DrawJob job_of(const Setting& setting, const std::vector<std::string>& names) const {
    DrawJob job;
    job.program = effect_scenes();
    job.setting = setting;
    job.folders = options_.folders;
    job.scenes = names;
    job.frames = options_.frames;
    job.width = options_.width;
    job.height = options_.height;
    job.cores = {core_to_use(options_.core)};
    job.out = options_.out / "effects";
    return job;
  }

  // The log is returned.
  std::string draw_one(const std::string& name, const Setting& setting) const {
    DrawJob job = job_of(setting, {name});
    job.frames = 0;
    draw_scenes(job);
    return whole_file(job.out / "log.txt");
  }

  // A value for each step, from one process.
  std::vector<double> time_once(const Setting& setting) {
    const DrawnScenes drawn = draw_scenes(job_of(setting, names_));
    if (setting.library == Library::ours)
      result_.our_renderer = drawn.renderer, result_.our_version = drawn.version;
    else
      result_.mesa_version = drawn.version;
    std::vector<double> ms;
    for (const DrawnScene& scene : drawn.scenes) ms.push_back(summarize(scene.cpu_ms).median);
    return ms;
  }

  void time(std::vector<EffectStep>& steps) {
    std::vector<std::vector<double>> ours(names_.size()), mesa(names_.size());
    std::vector<double> idle_ratio;
    for (int round = 0; round < options_.rounds; ++round) {
      progress_("effects: time, round " + std::to_string(round + 1) + " of " +
                std::to_string(options_.rounds));
      const std::vector<double> by_us = time_once(standard_setting()),
                                by_mesa = time_once(mesa_settings().front());
      for (size_t i = 0; i < names_.size(); ++i) ours[i].push_back(by_us[i]), mesa[i].push_back(by_mesa[i]);
      idle_ratio.push_back(by_us.back() / by_us.front());
    }
    for (size_t i = 0; i < names_.size(); ++i)
      steps[i].ours = summarize(ours[i]), steps[i].mesa = summarize(mesa[i]);
    result_.idle_ratio = summarize(idle_ratio);
  }

  // A frame is what is left when a run of one frame is taken from one of three, halved. At AVX2, the widest
  // level valgrind knows.
  double count_instructions(const std::string& name) const {
    progress_("effects: instructions of " + name);
    return (count_process(name, 3) - count_process(name, 1)) / 2;
  }

  double count_process(const std::string& name, int frames) const {
    ChildCommand command;
    command.arguments = {"valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
                         house_program(effect_scenes().name).string()};
    for (const std::string& word :
         {std::string("--draw"), name, std::string("--frames"), std::to_string(frames), std::string("--size"),
          std::string("256x256"), std::string("--no-pictures")})
      command.arguments.push_back(word);
    command.environment = environment_of(standard_setting(), options_.folders, "libOSMesa.so.8");
    command.environment.emplace_back("HALFSPACE_ISA", "avx2");
    command.output = options_.out / "effects" / "callgrind.txt";
    const ChildResult child = run_child(command);
    const std::string log = whole_file(command.output);
    constexpr std::string_view kBefore = "Collected : ";
    const size_t at = log.find(kBefore);
    if (child.exit_code != 0 || at == std::string::npos)
      throw std::runtime_error("valgrind could not count the instructions of " + name + ":\n" + log);
    return std::stod(log.substr(at + kBefore.size()));
  }

  void take(std::vector<EffectStep> steps) {
    if (steps.size() < 2 || steps.back().name != kIdle)
      throw std::runtime_error(std::string(effect_scenes().name) + " --list does not end with " + kIdle);
    result_.idle = std::move(steps.back());
    steps.pop_back();
    result_.steps = std::move(steps);
  }

  const CostOptions& options_;
  const Progress& progress_;
  std::vector<std::string> names_, descriptions_;
  EffectsResult result_;
};

void find_stages_of(EffectsResult& result, const EffectStages& effect, size_t own) {
  for (size_t i = 0; i < result.steps.size(); ++i)
    for (const StageUse& stage : result.steps[i].statistics.stages) {
      if (!belongs_to(effect, stage.name)) continue;
      if (i < own) result.done_while_off += stage.fragments;
      if (i == own) result.steps[own].stages.push_back(stage.name);
    }
  for (const StageUse& stage : result.idle.statistics.stages)
    if (belongs_to(effect, stage.name)) result.done_while_off += stage.fragments;
  if (result.steps[own].stages.empty())
    throw std::runtime_error(std::string("no stage known as one of ") + effect.effect +
                             " ran; does raster/fragment/stages.def have other names by now?");
}

size_t step_index(const EffectsResult& result, const std::string& name) {
  const auto found = std::find_if(result.steps.begin(), result.steps.end(),
                                  [&name](const EffectStep& step) { return step.name == name; });
  if (found == result.steps.end()) throw std::runtime_error("there is no effect " + name);
  return static_cast<size_t>(found - result.steps.begin());
}

}  // namespace

PictureStatistics statistics_of(const std::string& log) {
  std::istringstream lines(log);
  std::string line;
  while (std::getline(lines, line) && line.find("halfspace: picture:") == std::string::npos) {
  }
  if (!lines) throw std::runtime_error("HALFSPACE_STATS=1 told of no picture:\n" + log);
  PictureStatistics statistics;
  statistics.vertices = number_before(line, "vertices");
  statistics.lit_vertices = number_before(line, "lit");
  statistics.fragments = number_before(line, "fragments");
  while (std::getline(lines, line) && line.starts_with("  ")) {
    std::istringstream words(line);
    StageUse stage;
    if (words >> stage.name >> stage.fragments) statistics.stages.push_back(stage);
  }
  return statistics;
}

EffectsResult measure_effects(const CostOptions& options, bool instructions, const Progress& progress) {
  return EffectsRun(options, progress).measure(instructions);
}

void find_stages(EffectsResult& result) {
  result.done_while_off = result.idle.statistics.lit_vertices;
  for (const EffectStages& effect : kStages)
    find_stages_of(result, effect, step_index(result, effect.effect));
  const size_t light = step_index(result, kLight);
  for (size_t i = 0; i < light; ++i) result.done_while_off += result.steps[i].statistics.lit_vertices;
  if (result.steps[light].statistics.lit_vertices == 0)
    throw std::runtime_error("no vertex was lit where lighting is on");
  result.steps[light].stages.push_back("(vertices) lighting");
}

}  // namespace halfspace::compare
