// Programs that draw named scenes through libOSMesa and report as ref_app does: ref_app itself, the hard
// cases, the effects. Run as child processes by a setting of ours.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/cost_settings.h"

namespace halfspace::compare {

struct SceneProgram {
  std::string name;          // as house_program finds it
  std::string scene_option;  // before each scene's argument
  bool paints = false;       // understands --paint owners and --paint texels
  bool chooses_format =
      true;  // understands --format and --no-pictures; otherwise --out makes it save pictures
};

struct DrawJob {
  SceneProgram program;
  Setting setting;
  LibraryFolders folders;
  std::vector<std::string> scenes;  // arguments of scene_option
  std::string paint = "scene";
  int frames = 0;  // timed ones after the first
  int width = 512, height = 512;
  std::vector<int> cores;                        // empty: any
  bool pictures = false;                         // saved as PNG
  std::filesystem::path out;                     // folder of the pictures, result.json and log.txt
  std::vector<EnvironmentVariable> environment;  // on top of the setting's
};

struct DrawnScene {
  std::string name;
  std::vector<double> cpu_ms;  // processor time of each timed frame
  std::filesystem::path picture;
};

struct DrawnScenes {
  std::string renderer, version;   // GL_RENDERER, GL_VERSION
  std::vector<DrawnScene> scenes;  // as in the job
};

// Throws StartError, NotFound, and std::runtime_error when the program failed or another renderer drew.
DrawnScenes draw_scenes(const DrawJob& job);

// What the program's --list says: a scene a line, its name and, behind a tab, a description. Throws as above.
std::vector<std::string> listed_lines(const SceneProgram& program);
// The names alone.
std::vector<std::string> listed_scenes(const SceneProgram& program);

}  // namespace halfspace::compare
