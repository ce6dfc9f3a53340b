// The pictures to be judged: ref_app runs as a child process on a library each.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compare/scene_run.h"
#include "tests/differential/judgement.h"

namespace halfspace::differential {

struct DrawJob {
  std::vector<int> scenes;
  int width = 1024, height = 1024;
  std::filesystem::path out;  // a folder for each renderer is made in it
};

struct Drawings {
  std::string gl_renderer;
  std::map<int, Drawn> scenes;
};

// Draws everything. Throws std::runtime_error when the program fails or another library drew than was asked
// for. `with_owners`: the scenes are drawn a second time, to learn which primitive each pixel shows.
Drawings draw_scenes(const DrawJob& job, compare::Renderer renderer, bool with_owners);

// Whether the system has a libOSMesa to compare with; otherwise the linker's words.
std::optional<std::string> why_no_osmesa();

}  // namespace halfspace::differential
