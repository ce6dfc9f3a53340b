// The reference program as a child process: which library draws, how often, on which cores; and what it
// reports.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/process.h"

namespace halfspace::compare {

constexpr int kSceneCount = 8;

enum class Renderer {
  ours,
  ours_draft,    // the filter at the draft level: 8-bit weights, as llvmpipe has them
  osmesa,        // Debian's libOSMesa, llvmpipe
  osmesa_float,  // the same, made to filter textures in float
};

// "Halfspace", "Halfspace, draft", "OSMesa", "OSMesa, float filter".
const char* renderer_name(Renderer renderer);

struct SceneJob {
  Renderer renderer = Renderer::ours;
  std::vector<int> scenes;  // 1 .. 8; empty: all
  int frames = 5;           // after the first one
  int width = 1024, height = 1024;
  int threads = 0;         // 0: as many as the library chooses
  std::vector<int> cores;  // empty: any
  std::filesystem::path out;           // folder of the pictures, result.json and log.txt
  bool pictures = true;                // saved as PNG
  std::string paint = "scene";         // what they show: ref_app's --paint
  std::optional<std::string> library;  // folder of our libOSMesa.so.8
};

struct SceneTime {
  int scene = 0;
  std::string name;
  double first_ms = 0;
  double median_ms = 0;           // of the later frames: clear + draw + finish
  std::vector<double> frames_ms;  // each of them
  std::filesystem::path picture;
};

struct SceneResult {
  std::string renderer, version;  // GL_RENDERER, GL_VERSION
  double first_picture_ms = 0;    // from process start
  long peak_kib = 0;              // largest resident set
  std::vector<SceneTime> scenes;
  double process_seconds = 0;
};

// Runs ref_app to its end and reads what it wrote. Throws StartError, NotFound, and std::runtime_error when
// it failed or when another library drew than was asked for.
SceneResult run_scenes(const SceneJob& job);

// Reads the JSON file ref_app writes. Throws std::runtime_error.
SceneResult read_scene_result(const std::filesystem::path& path);

}  // namespace halfspace::compare
