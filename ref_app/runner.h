#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ref_app/assets.h"
#include "ref_app/backend.h"
#include "ref_app/options.h"
#include "ref_app/scenes.h"

namespace ref_app {

struct SceneSource {
  int number = 0;
  std::string name;
  std::string file;  // of its picture, without the extension
  std::function<std::unique_ptr<Scene>(Renderer&, const Assets&)> make;
};

// The reference scenes of those numbers.
std::vector<SceneSource> reference_scenes(const std::vector<int>& numbers);

// Draws the scenes, times them, saves the pictures. Returns the program's exit code.
int run_scenes(Backend& backend, const Options& options, const std::vector<SceneSource>& scenes);

}  // namespace ref_app
