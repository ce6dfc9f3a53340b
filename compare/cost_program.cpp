#include "compare/cost_program.h"

#include <algorithm>
#include <stdexcept>

#include "compare/capture.h"
#include "compare/cost_scenes.h"
#include "compare/cost_truth.h"

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;

// The folder has libGL.so.1, too: whichever of the two the program loads is the setting's.
constexpr const char* kLibrary = "libOSMesa.so.8";

class ProgramRun {
 public:
  ProgramRun(const CostOptions& options, const Progress& progress)
      : options_(options), progress_(progress), settings_(chosen_settings(options)) {}

  CostScene measure() {
    CostScene scene{fs::path(options_.program.front()).filename().string(), {}};
    time(scene);
    judge(scene);
    return scene;
  }

 private:
  double run(const Setting& setting, const std::string& folder, const EnvironmentVariable& also) const {
    ChildCommand command;
    command.arguments = options_.program;
    command.environment = environment_of(setting, options_.folders, kLibrary);
    command.environment.push_back(also);
    command.cores = {core_to_use(options_.core)};
    fs::create_directories(options_.out / folder);
    command.output = options_.out / folder / "log.txt";
    const ChildResult child = run_child(command);
    if (child.exit_code != 0)
      throw std::runtime_error(options_.program.front() + " ended with status " +
                               std::to_string(child.exit_code) + " under " + setting.name +
                               "; its words are in " + command.output.string());
    return 1000 * child.cpu_seconds;
  }

  void time(CostScene& scene) const {
    std::vector<std::vector<double>> ms(settings_.size()), ratio(settings_.size());
    for (int round = 0; round < options_.rounds; ++round) {
      progress_(scene.name + ": time, round " + std::to_string(round + 1) + " of " +
                std::to_string(options_.rounds));
      for (size_t k = 0; k < settings_.size(); ++k)
        ms[k].push_back(run(settings_[k], "time", {"HALFSPACE_CAPTURE", ""}));
      for (size_t k = 0; k < settings_.size(); ++k)
        ratio[k].push_back(ms[k].back() / std::max(ms[standard_index(settings_)].back(), 1e-9));
    }
    for (size_t k = 0; k < settings_.size(); ++k)
      scene.points.push_back({settings_[k], summarize(ms[k]), summarize(ratio[k]), {}});
  }

  // Frames of an earlier run must not be taken for this one's.
  fs::path frame_of(const Setting& setting, const std::string& folder, const char* variable,
                    const std::string& extension) const {
    fs::remove_all(options_.out / folder);
    run(setting, folder, {variable, fs::absolute(options_.out / folder).string()});
    const std::vector<fs::path> frames = captured_frames(options_.out / folder, extension);
    if (frames.size() <= static_cast<size_t>(options_.frame))
      throw std::runtime_error(options_.program.front() + " showed " + std::to_string(frames.size()) +
                               " frames under " + setting.name + ", so there is no frame " +
                               std::to_string(options_.frame));
    return frames[static_cast<size_t>(options_.frame)];
  }

  void judge(CostScene& scene) const {
    progress_(scene.name + ": truth");
    const Truth truth = load_truth(frame_of(truth_setting(), "truth/program", "HALFSPACE_TRUTH", "truth"));
    for (CostPoint& point : scene.points) {
      if (point.setting.library != Library::ours) continue;
      progress_(scene.name + ": picture by " + point.setting.name);
      const fs::path picture = frame_of(point.setting, "pictures/program", "HALFSPACE_CAPTURE", "ppm");
      point.error = error_of(load_image(picture), truth);
    }
  }

  const CostOptions& options_;
  const Progress& progress_;
  const std::vector<Setting> settings_;
};

}  // namespace

void measure_program(const CostOptions& options, const Progress& progress, CostResult& result) {
  result.scenes.push_back(ProgramRun(options, progress).measure());
}

}  // namespace halfspace::compare
