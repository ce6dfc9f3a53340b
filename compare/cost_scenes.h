// Which scenes and which settings `halfspace cost` was asked for.
#pragma once

#include <string>
#include <vector>

#include "compare/cost.h"

namespace halfspace::compare {

// Scenes that one program draws, in one process a setting.
struct SceneGroup {
  SceneProgram program;
  std::vector<std::string> arguments;  // of the program's scene_option
  std::vector<std::string> labels;     // for people
};

const SceneProgram& reference_scenes();
const SceneProgram& hard_cases();
const SceneProgram& effect_scenes();

// Throws std::runtime_error for a scene or a case there is not.
std::vector<SceneGroup> chosen_groups(const CostOptions& options);
std::vector<Setting> chosen_settings(const CostOptions& options);

std::vector<std::string> paints_of(const SceneProgram& program);
size_t standard_index(const std::vector<Setting>& settings);

}  // namespace halfspace::compare
