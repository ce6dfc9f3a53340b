#include "compare/cost_settings.h"

#include "compare/libraries.h"
#include "raster/api/accuracy.h"

namespace halfspace::compare {
namespace {

constexpr const char* kAccuracy = "HALFSPACE_ACCURACY";

Setting level_setting(const std::string& level) {
  return {level, Library::ours, {{kAccuracy, level}}, "", level};
}

Setting axis_setting(const std::string& axis, const std::string& level) {
  return {axis + " " + level, Library::ours, {{kAccuracy, "standard," + axis + "=" + level}}, axis, level};
}

// llvmpipe counts helpers beside the calling thread: none of them is one thread.
Setting mesa_setting(const std::string& name, const std::string& driver, const std::string& gallivm_perf) {
  return {name,
          Library::mesa,
          {{"GALLIUM_DRIVER", driver}, {"LP_NUM_THREADS", "0"}, {"GALLIVM_PERF", gallivm_perf}},
          "",
          ""};
}

}  // namespace

Setting truth_setting() { return {"truth", Library::oracle, {}, "", ""}; }
Setting standard_setting() { return level_setting("standard"); }

std::vector<Setting> our_settings() {
  std::vector<Setting> settings;
  for (const char* level : raster::kLevelNames) settings.push_back(level_setting(level));
  for (const raster::AccuracyAxis& axis : raster::kAccuracyAxes)
    for (const char* level : {"draft", "exact"}) settings.push_back(axis_setting(axis.name, level));
  return settings;
}

std::vector<Setting> mesa_settings() {
  return {mesa_setting("llvmpipe", "llvmpipe", ""),
          mesa_setting("llvmpipe, float filter", "llvmpipe", "no_aos_sampling"),
          mesa_setting("softpipe", "softpipe", "")};
}

std::vector<EnvironmentVariable> environment_of(const Setting& setting, const LibraryFolders& folders,
                                                const std::string& library) {
  std::vector<EnvironmentVariable> environment = setting.environment;
  if (setting.library == Library::ours)
    environment.push_back(library_path_with(library_folder(library, folders.ours)));
  if (setting.library == Library::oracle)
    environment.push_back(library_path_with(oracle_folder(library, folders.oracle)));
  environment.emplace_back("HALFSPACE_THREADS", "1");
  return environment;
}

bool is_renderer_of(const Setting& setting, const std::string& gl_renderer) {
  if (setting.library == Library::oracle) return gl_renderer.starts_with("Halfspace oracle");
  if (setting.library == Library::ours)
    return gl_renderer.starts_with("Halfspace") && !gl_renderer.starts_with("Halfspace oracle");
  return gl_renderer.starts_with(setting.environment.front().second);
}

}  // namespace halfspace::compare
