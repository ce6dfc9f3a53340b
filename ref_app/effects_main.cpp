// ref_app_effects: draws one scene through OSMesa, effects added to it one by one.
#include <cstdio>
#include <exception>

#include "ref_app/effects.h"
#include "ref_app/process_clock.h"
#include "ref_app/runner.h"

namespace {

int list_effects() {
  for (const std::string& name : ref_app::effect_names())
    std::printf("%s\t%s\n", name.c_str(), ref_app::effect_description(name));
  return 0;
}

int draw(const ref_app::EffectOptions& options) {
  std::vector<ref_app::SceneSource> sources;
  for (const std::string& name : options.effects) {
    sources.push_back(
        {static_cast<int>(sources.size()) + 1, name, name,
         [name](ref_app::Renderer&, const ref_app::Assets&) { return ref_app::make_effect_scene(name); }});
  }
  ref_app::BackendOptions backend_options{options.drawing.width, options.drawing.height};
  backend_options.stencil_bits = 8;
  const auto backend = ref_app::make_backend(backend_options);
  return ref_app::run_scenes(*backend, options.drawing, sources);
}

}  // namespace

int main(int argc, char** argv) {
  ref_app::note_process_start();
  try {
    ref_app::EffectOptions options;
    int exit_code = 0;
    if (!ref_app::parse_effect_options(argc, argv, ref_app::effect_names(), options, exit_code))
      return exit_code;
    return options.list ? list_effects() : draw(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ref_app_effects: %s\n", error.what());
    return 1;
  }
}
