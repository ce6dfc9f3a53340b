#include <unistd.h>

#include <cstdio>
#include <exception>
#include <string>

#include "ref_app/assets.h"
#include "ref_app/backend.h"
#include "ref_app/input_error.h"
#include "ref_app/options.h"
#include "ref_app/process_clock.h"
#include "ref_app/program_path.h"
#include "ref_app/runner.h"
#include "ref_app/viewer.h"

namespace {

// Every backend is a program of its own, since one process can have only one OpenGL. Does not return.
[[noreturn]] void become_backend(const std::string& backend, char** argv) {
  const std::string name = backend == "glx" ? "ref_app" : "ref_app_" + backend;
  const std::string path = ref_app::program_directory() + "/" + name;
  ref_app::export_process_start();
  execv(path.c_str(), argv);
  throw ref_app::InputError("the backend " + backend + " is not here: cannot start " + path);
}

int run(const ref_app::Options& options, char** argv) {
  if (!options.backend.empty() && options.backend != ref_app::backend_name())
    become_backend(options.backend, argv);
  if (!options.write_assets.empty()) {
    ref_app::Assets(options.assets, options.model).write(options.write_assets);
    std::printf("images are in %s\n", options.write_assets.c_str());
    return 0;
  }
  const auto backend = ref_app::make_backend({options.width, options.height, options.window});
  if (options.window) return ref_app::run_viewer(*backend, options);
  return ref_app::run_scenes(*backend, options, ref_app::reference_scenes(options.scenes));
}

}  // namespace

int main(int argc, char** argv) {
  ref_app::note_process_start();
  try {
    ref_app::Options options;
    int exit_code = 0;
    if (!ref_app::parse_options(argc, argv, options, exit_code)) return exit_code;
    return run(options, argv);
  } catch (const ref_app::InputError& error) {
    std::fprintf(stderr, "ref_app: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ref_app: %s\n", error.what());
    return 1;
  }
}
