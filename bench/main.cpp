// workloads: draws the benchmark's workloads with any libOSMesa.
#include <sched.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bench/memory.h"
#include "bench/runner.h"
#include "bench/start_up.h"

namespace {

using namespace halfspace::bench;
using Json = nlohmann::json;

struct Options {
  std::string library = "libOSMesa.so.8";
  std::vector<std::string> only;
  int frames = 0;  // 0: for half a second
  int core = -1;
  Screen screen;
  std::string pictures, json;
  bool list = false, serve = false;
};

void pin_to(int core) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<unsigned>(core), &set);
  if (sched_setaffinity(0, sizeof set, &set) != 0)
    throw std::runtime_error("cannot run on core " + std::to_string(core));
}

int chosen_frames(const Options& options, const Times& one_frame) {
  if (options.frames > 0) return options.frames;
  constexpr double kBudgetMs = 500;
  return std::max(3, static_cast<int>(kBudgetMs / std::max(one_frame.wall_ms, 0.01)));
}

// The first frame is not counted: it finds nothing in the caches, and llvmpipe compiles in it.
Json measure(const Library& library, const Options& options, const Workload& workload) {
  Run run(library, workload.prepare, options.screen);
  const Times first = run.frames(1);
  const int frames = chosen_frames(options, options.frames > 0 ? first : run.frames(1));
  const Times time = run.frames(frames);
  if (!options.pictures.empty()) {
    std::filesystem::create_directories(options.pictures);
    run.save_picture(std::filesystem::path(options.pictures) / (std::string(workload.name) + ".ppm"));
  }
  return {{"name", workload.name},
          {"frames", frames},
          {"first_ms", first.wall_ms},
          {"cpu_ms", time.cpu_ms / frames},
          {"wall_ms", time.wall_ms / frames}};
}

void measure_all(const Library& library, const Options& options) {
  std::vector<Workload> chosen;
  for (const std::string& name : options.only) chosen.push_back(workload_named(name));
  if (chosen.empty()) chosen = all_workloads();
  std::printf("%-26s %8s %12s %12s\n", "workload", "frames", "cpu ms", "wall ms");
  Json results = Json::array();
  for (const Workload& workload : chosen) {
    const Json result = measure(library, options, workload);
    std::printf("%-26s %8d %12.3f %12.3f\n", workload.name, result["frames"].get<int>(),
                result["cpu_ms"].get<double>(), result["wall_ms"].get<double>());
    std::fflush(stdout);
    results.push_back(result);
  }
  if (!options.json.empty()) std::ofstream(options.json) << results.dump(2) << "\n";
}

void run(const Options& options) {
  if (options.list) {
    std::puts(list_of_workloads().dump(2).c_str());
    return;
  }
  if (options.core >= 0) pin_to(options.core);
  const long unloaded_kib = memory_now().resident_kib;
  const Library library(options.library);
  set_start_up_library(library.path());
  if (options.serve)
    serve(library, options.screen, unloaded_kib, std::cin, std::cout);
  else
    measure_all(library, options);
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("--library", options.library, "The libOSMesa that draws")->capture_default_str();
  app.add_option("--only", options.only, "Only these workloads, with commas between them")->delimiter(',');
  app.add_option("--frames", options.frames, "Frames measured; default: as many as take half a second");
  app.add_option("--core", options.core, "Core to stay on");
  app.add_option("--width", options.screen.width, "Of the picture")->capture_default_str();
  app.add_option("--height", options.screen.height, "Of the picture")->capture_default_str();
  app.add_option("--picture", options.pictures, "Folder for the last frame of each, as PPM");
  app.add_option("--json", options.json, "File for the numbers");
  app.add_flag("--list", options.list, "Name the workloads, as JSON");
  app.add_flag("--serve", options.serve, "Take orders from standard input; bench/runner.h lists them");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc == 3 && std::strcmp(argv[1], kFirstFrame) == 0) draw_first_frame(argv[2]);
    CLI::App app{"Draws the benchmark's workloads with any libOSMesa, and tells the time of a frame."};
    Options options;
    add_options(app, options);
    CLI11_PARSE(app, argc, argv);
    run(options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "workloads: %s\n", error.what());
    return 2;
  }
}
