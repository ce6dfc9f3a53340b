#include "ref_app/options.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "ref_app/scenes.h"

namespace ref_app {
namespace {

constexpr int kLargestSize = 16384;

// "1024x768"; false when it is anything else.
bool parse_size(const std::string& text, int& width, int& height) {
  int end = 0;
  const bool read = std::sscanf(text.c_str(), "%5dx%5d%n", &width, &height, &end) == 2;
  return read && static_cast<size_t>(end) == text.size() && width >= 1 && height >= 1 &&
         width <= kLargestSize && height <= kLargestSize;
}

// What a command line says in other words than Options has them.
struct Said {
  std::string size = "1024x1024";
  bool no_pictures = false;
};

void add_drawing_options(CLI::App& app, Options& options, Said& said) {
  app.add_option("--size", said.size, "Picture size, WIDTHxHEIGHT")
      ->check([](const std::string& text) {
        int width = 0, height = 0;
        return parse_size(text, width, height) ? std::string()
                                               : "'" + text + "' is not a size like 1024x1024";
      })
      ->capture_default_str();
  app.add_option("--frames", options.frames, "Frames to time after the first one")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  app.add_option("--out", options.out, "Folder for the pictures")->capture_default_str();
  app.add_option("--format", options.format, "Pictures' format")
      ->check(CLI::IsMember({"bmp", "png"}))
      ->capture_default_str();
  app.add_flag("--no-pictures", said.no_pictures, "Time only, save nothing");
  app.add_option("--json", options.json,
                 "Write times, picture names and the renderer's strings to this file");
}

// False for help, or an error that has been printed.
bool parse(CLI::App& app, int argc, char** argv, const Said& said, Options& options, int& exit_code) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& refusal) {
    exit_code = app.exit(refusal) == 0 ? 0 : 2;
    return false;
  }
  parse_size(said.size, options.width, options.height);
  options.pictures = !said.no_pictures;
  return true;
}

}  // namespace

bool parse_options(int argc, char** argv, Options& options, int& exit_code) {
  CLI::App app(
      "Draws the eight reference scenes with whatever OpenGL it finds, and says how long each took.");
  Said said;
  std::vector<int> scenes;
  app.add_option("--scene", scenes, "Only this scene, 1 to 8; may be given again")
      ->check(CLI::Range(1, kSceneCount));
  add_drawing_options(app, options, said);
  app.add_option("--backend", options.backend, "What to draw with")
      ->check(CLI::IsMember({"glx", "osmesa", "raster"}));
  app.add_option("--paint", options.paint,
                 "What the pixels show: how the scene looks, which primitive drew them, or where in a "
                 "texture they looked")
      ->check(CLI::IsMember({"scene", "owners", "texels"}))
      ->capture_default_str();
  app.add_option("--assets", options.assets, "Folder with images to take in place of the computed ones");
  app.add_option("--write-assets", options.write_assets,
                 "Write the computed images to this folder, and stop");
  app.add_option("--model", options.model, "A Wavefront OBJ file in the teapot's place");
  app.add_flag("--window", options.window,
               "Show a window (glx). Arrows turn, 1-8 choose a scene, space starts and stops, Esc ends");
  app.add_flag("--animate", options.animate,
               "Move from the start; without --window, each frame shows a later moment");
  if (!parse(app, argc, argv, said, options, exit_code)) return false;
  if (!scenes.empty()) options.scenes = scenes;
  return true;
}

bool parse_effect_options(int argc, char** argv, const std::vector<std::string>& effects,
                          EffectOptions& options, int& exit_code) {
  CLI::App app(
      "Draws one scene with whatever libOSMesa it finds, effects added to it one by one, and says how long "
      "each took.");
  Said said;
  app.add_option("--draw", options.effects, "Only up to this effect; may be given again")
      ->check(CLI::IsMember(effects));
  app.add_flag("--list", options.list, "Name the effects, in their order, and stop");
  add_drawing_options(app, options.drawing, said);
  if (!parse(app, argc, argv, said, options.drawing, exit_code)) return false;
  if (options.effects.empty()) options.effects = effects;
  return true;
}

}  // namespace ref_app
