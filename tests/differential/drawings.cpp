#include "tests/differential/drawings.h"

#include <dlfcn.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "compare/libraries.h"

namespace halfspace::differential {
namespace {

namespace fs = std::filesystem;
using compare::Renderer;

bool is_ours(Renderer renderer) { return renderer == Renderer::ours || renderer == Renderer::ours_draft; }

const char* folder_name(Renderer renderer) {
  switch (renderer) {
    case Renderer::ours:
      return "ours";
    case Renderer::ours_draft:
      return "ours_draft";
    case Renderer::osmesa:
      return "osmesa";
    case Renderer::osmesa_float:
      return "osmesa_float";
  }
  return "";
}

std::string whole_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<Owner> owners_from(const compare::Image& image) {
  std::vector<Owner> owner;
  owner.reserve(image.pixels.size());
  for (int y = image.height - 1; y >= 0; --y) {
    for (int x = 0; x < image.width; ++x) {
      const compare::Pixel& p = image.at(x, y);
      const auto byte = [&p](size_t k) { return static_cast<Owner>(std::lround(p[k])); };
      owner.push_back(byte(0) | byte(1) << 8 | byte(2) << 16);
    }
  }
  return owner;
}

void draw_owners(const DrawJob& job, Renderer renderer, Drawings& drawings) {
  const fs::path out = job.out / (std::string(folder_name(renderer)) + "_owners");
  fs::create_directories(out);
  compare::ChildCommand command;
  command.arguments = {compare::house_program("ref_app_osmesa").string(),
                       "--paint",
                       "owners",
                       "--size",
                       std::to_string(job.width) + "x" + std::to_string(job.height),
                       "--frames",
                       "0",
                       "--format",
                       "png",
                       "--out",
                       out.string(),
                       "--json",
                       (out / "result.json").string()};
  for (const int scene : job.scenes) {
    command.arguments.insert(command.arguments.end(), {"--scene", std::to_string(scene)});
  }
  if (is_ours(renderer)) {
    command.environment.push_back(compare::library_path_with(compare::library_folder("libOSMesa.so.8")));
  } else {
    command.environment.emplace_back("GALLIUM_DRIVER", "llvmpipe");
  }
  command.output = out / "log.txt";
  if (compare::run_child(command).exit_code != 0)
    throw std::runtime_error("ref_app_osmesa --paint owners failed:\n" + whole_file(command.output));
  const compare::SceneResult result = compare::read_scene_result(out / "result.json");
  if (result.renderer.starts_with("Halfspace") != is_ours(renderer))
    throw std::runtime_error("\"" + result.renderer + "\" drew in place of " +
                             compare::renderer_name(renderer));
  for (const compare::SceneTime& scene : result.scenes)
    drawings.scenes.at(scene.scene).owner = owners_from(compare::load_image(scene.picture));
}

}  // namespace

Drawings draw_scenes(const DrawJob& job, Renderer renderer, bool with_owners) {
  compare::SceneJob pictures;
  pictures.renderer = renderer;
  pictures.scenes = job.scenes;
  pictures.frames = 0;
  pictures.width = job.width, pictures.height = job.height;
  pictures.out = job.out / folder_name(renderer);
  const compare::SceneResult result = compare::run_scenes(pictures);
  Drawings drawings;
  drawings.gl_renderer = result.renderer;
  for (const compare::SceneTime& scene : result.scenes)
    drawings.scenes[scene.scene].picture = compare::load_image(scene.picture);
  if (with_owners) draw_owners(job, renderer, drawings);
  return drawings;
}

std::optional<std::string> why_no_osmesa() {
  void* library = dlopen("libOSMesa.so.8", RTLD_LAZY | RTLD_LOCAL);
  if (library != nullptr) return std::nullopt;  // left open: its helpers may be running
  const char* words = dlerror();
  return words == nullptr ? "libOSMesa.so.8 cannot be loaded" : words;
}

}  // namespace halfspace::differential
