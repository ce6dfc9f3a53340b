#pragma once

#include <string>
#include <vector>

namespace ref_app {

struct Options {
  std::vector<int> scenes{1, 2, 3, 4, 5, 6, 7, 8};
  int width = 1024, height = 1024;
  int frames = 5;  // timed after the first one
  std::string out = "out", format = "bmp", json;
  std::string paint = "scene";
  std::string backend;  // empty: this program's own
  std::string assets, write_assets, model;
  bool pictures = true;
  bool window = false, animate = false;
};

// Reads the command line. Returns true to go on; otherwise the program ends with `exit_code` (help, or an
// error that has been printed).
bool parse_options(int argc, char** argv, Options& options, int& exit_code);

struct EffectOptions {
  Options drawing;
  std::vector<std::string> effects;
  bool list = false;
};

// The same for the program that draws effects; `effects` is what there is.
bool parse_effect_options(int argc, char** argv, const std::vector<std::string>& effects,
                          EffectOptions& options, int& exit_code);

}  // namespace ref_app
