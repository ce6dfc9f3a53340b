// halfspace bench scenes: our time against OSMesa's, in one run.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "compare/bench_scenes.h"
#include "compare/commands.h"
#include "compare/html.h"

namespace halfspace::compare {
namespace {

int bench(const BenchOptions& options) {
  try {
    const BenchResult result = bench_scenes(options, [](const std::string& what) {
      std::fprintf(stderr, "halfspace bench: %s\n", what.c_str());
    });
    std::fputs(to_text(result).c_str(), stdout);
    write_text(options.out / "scenes.json", to_json(result).dump(2) + "\n");
    write_text(options.out / "scenes.svg", to_svg(result));
    std::printf("numbers in %s, chart in %s\n", (options.out / "scenes.json").c_str(),
                (options.out / "scenes.svg").c_str());
    return all_good(result) ? kGood : kLimitBroken;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "halfspace bench: %s\n", error.what());
    return kCouldNotTell;
  }
}

void add_scenes_command(CLI::App& bench_app, int& status) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command =
      bench_app.add_subcommand("scenes", "The eight scenes against OSMesa llvmpipe, one thread each");
  command->footer("Exit status: 0 every target kept, 1 some missed, 2 could not be measured.");
  command->add_option("--scene", options->scenes, "Only this scene; may be repeated")
      ->check(CLI::Range(1, kSceneCount));
  command->add_option("--pairs", options->pairs, "Alternating pairs")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("--frames", options->frames, "Frames a process")
      ->capture_default_str()
      ->check(CLI::Range(1, 10000));
  command->add_option("--core", options->core, "Core both are pinned to; default: the last one");
  command->add_option("--library", options->library, "Folder that holds our libOSMesa.so.8")
      ->type_name("DIR");
  command->add_option("--out", options->out, "Folder for scenes.json and scenes.svg")->capture_default_str();
  command->callback([options, &status] { status = bench(*options); });
}

}  // namespace

void add_bench_command(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("bench", "Measure time and memory");
  command->require_subcommand(1);
  add_scenes_command(*command, status);
}

}  // namespace halfspace::compare
