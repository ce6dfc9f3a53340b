// halfspace bench: our time against others', in one run.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "compare/bench_cores.h"
#include "compare/bench_limits.h"
#include "compare/bench_scale.h"
#include "compare/bench_scenes.h"
#include "compare/bench_workloads.h"
#include "compare/commands.h"
#include "compare/html.h"
#include "compare/process.h"

namespace halfspace::compare {
namespace {

void tell(const std::string& what) { std::fprintf(stderr, "halfspace bench: %s\n", what.c_str()); }

// Prints `result`, and writes it to `name`.json and `name`.svg.
template <typename Result>
int report(const Result& result, const std::filesystem::path& out, const std::string& name) {
  std::fputs(to_text(result).c_str(), stdout);
  const std::filesystem::path json = out / (name + ".json"), svg = out / (name + ".svg");
  write_text(json, to_json(result).dump(2) + "\n");
  write_text(svg, to_svg(result));
  std::printf("numbers in %s, chart in %s\n", json.c_str(), svg.c_str());
  return all_good(result) ? kGood : kLimitBroken;
}

int or_complain(const std::function<int()>& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    tell(error.what());
    return kCouldNotTell;
  }
}

void add_library_and_out(CLI::App& command, std::optional<std::string>& library, std::filesystem::path& out) {
  command.add_option("--library", library, "Folder that holds our libOSMesa.so.8")->type_name("DIR");
  command.add_option("--out", out, "Folder for the numbers and charts")->capture_default_str();
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
  add_library_and_out(*command, options->library, options->out);
  command->callback([options, &status] {
    status = or_complain([&] { return report(bench_scenes(*options, tell), options->out, "scenes"); });
  });
}

struct LimitsOptions {
  int core = core_to_use(-1);
  double seconds = 0.5;
  std::filesystem::path out = "out/bench";
};

void add_limits_command(CLI::App& bench_app, int& status) {
  auto options = std::make_shared<LimitsOptions>();
  CLI::App* command = bench_app.add_subcommand("limits", "What one core of this machine can do at best");
  command->add_option("--core", options->core, "Core to stay on")->capture_default_str();
  command->add_option("--seconds", options->seconds, "For each")->capture_default_str();
  command->add_option("--out", options->out, "Folder for the numbers and the chart")->capture_default_str();
  command->callback([options, &status] {
    status = or_complain(
        [&] { return report(bench_limits(options->core, options->seconds), options->out, "limits"); });
  });
}

int scale_it(const ScaleOptions& options) {
  return or_complain([&] {
    const ScaleResult result = bench_scale(options, tell);
    std::fputs(to_text(result).c_str(), stdout);
    write_text(options.out / "scale.json", to_json(result).dump(2) + "\n");
    for (const ScaleCurve& curve : result.curves)
      write_text(options.out / ("scale_" + curve.name + ".svg"), to_svg(curve));
    std::printf("numbers in %s, curves beside it\n", (options.out / "scale.json").c_str());
    return kGood;
  });
}

void add_scale_command(CLI::App& bench_app, int& status) {
  auto options = std::make_shared<ScaleOptions>();
  CLI::App* command = bench_app.add_subcommand(
      "scale", "How time and memory grow with triangles, pixels, overdraw, textures, state changes");
  command->add_option("--only", options->only, "Only these curves, with commas between them")->delimiter(',');
  command->add_option("--most", options->most, "Leave larger amounts out");
  command->add_option("--rounds", options->rounds, "Times each has its turn")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("--core", options->core, "Core both are pinned to; default: the last one");
  add_library_and_out(*command, options->library, options->out);
  command->callback([options, &status] { status = scale_it(*options); });
}

void add_cores_command(CLI::App& bench_app, int& status) {
  auto options = std::make_shared<CoresOptions>();
  CLI::App* command =
      bench_app.add_subcommand("cores", "What more cores would do, simulated from a record of tasks");
  command->add_option("--only", options->only, "These workloads, with commas between them")->delimiter(',');
  command->add_option("--cores", options->cores, "Numbers of cores")->delimiter(',')->capture_default_str();
  command->add_option("--frames", options->frames, "Frames recorded")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("--wake", options->wake_us, "Microseconds until a helper begins")
      ->capture_default_str();
  add_library_and_out(*command, options->library, options->out);
  command->callback([options, &status] {
    status = or_complain([&] { return report(bench_cores(*options, tell), options->out, "cores"); });
  });
}

int bench_the_workloads(const WorkloadOptions& options) {
  return or_complain([&] {
    return report(bench_workloads(options, tell), options.out, options.against ? "against" : "workloads");
  });
}

void add_workload_options(CLI::App& command, WorkloadOptions& options) {
  command.add_option("--only", options.only, "Only these workloads, with commas between them")
      ->delimiter(',');
  command.add_option("--rounds", options.rounds, "Times each has its turn")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command.add_option("--core", options.core, "Core both are pinned to; default: the last one");
  command.add_flag("!--no-threads", options.threads, "Leave out two threads against one");
  CLI::Option* softpipe =
      command.add_flag("--softpipe", options.softpipe, "Against Mesa's softpipe instead of llvmpipe");
  command
      .add_option("--against", options.against,
                  "Against another build of ours: its libOSMesa.so.8, the folder of it, or its build tree")
      ->type_name("BASE")
      ->excludes(softpipe);
  command.add_option("--slower", options.slower_percent, "Per cent a workload may be slower than BASE")
      ->capture_default_str();
  add_library_and_out(command, options.library, options.out);
}

}  // namespace

void add_bench_command(CLI::App& app, int& status) {
  auto options = std::make_shared<WorkloadOptions>();
  CLI::App* command = app.add_subcommand("bench", "Measure time and memory");
  command->footer(
      "Without a subcommand: every workload of the benchmark, ours and Mesa's OSMesa in turns on one core.\n"
      "Exit status: 0 every target kept, 1 some missed, 2 could not be measured.");
  command->require_subcommand(0, 1);
  add_workload_options(*command, *options);
  add_scenes_command(*command, status);
  add_limits_command(*command, status);
  add_scale_command(*command, status);
  add_cores_command(*command, status);
  command->callback([command, options, &status] {
    if (command->get_subcommands().empty()) status = bench_the_workloads(*options);
  });
}

}  // namespace halfspace::compare
