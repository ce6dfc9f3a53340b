// halfspace cost: what accuracy costs in time, and what it buys in pixels.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "compare/commands.h"
#include "compare/cost.h"
#include "compare/cost_chart.h"
#include "compare/cost_page.h"
#include "compare/effects.h"
#include "compare/html.h"

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;

struct CostCommand {
  CostOptions options;
  bool no_axes = false, no_mesa = false;
  bool effects = false, instructions = false;
  std::string docs;  // folder of the page; empty: none is written
};

void tell(const std::string& what) { std::fprintf(stderr, "halfspace cost: %s\n", what.c_str()); }

void write_files(const CostResult& result, const fs::path& out) {
  write_text(out / "cost.csv", to_csv(result));
  write_text(out / "cost.json", to_json(result).dump(2) + "\n");
  const CostScene summary = result.scenes.size() > 1 ? all_scenes(result) : result.scenes.front();
  write_text(out / "cost.svg", scene_chart(summary));
  if (result.scenes.size() > 1) write_text(out / "cost_scenes.svg", scenes_chart(result));
  if (result.options.axes) write_text(out / "cost_axes.svg", axes_chart(scene_for_axes(result)));
}

int effects(const CostCommand& command) {
  const EffectsResult result = measure_effects(command.options, command.instructions, tell);
  std::fputs(to_text(result).c_str(), stdout);
  write_text(command.options.out / "effects.json", to_json(result).dump(2) + "\n");
  write_text(command.options.out / "effects.svg", effects_chart(result));
  std::printf("effects.json and effects.svg are in %s\n", command.options.out.c_str());
  return result.done_while_off == 0 ? kGood : kLimitBroken;
}

// Small and once: what matters of these is the error, and most of their time is their own making of
// triangles.
CostOptions options_of_cases(const CostOptions& options) {
  CostOptions cases = options;
  cases.scenes.clear();
  cases.cases = {"all"};
  cases.axes = false;
  cases.rounds = cases.frames = 1;
  cases.width = cases.height = 128;
  return cases;
}

bool has_program(const char* name) {
  ChildCommand command;
  command.arguments = {name, "--version"};
  command.output = "/dev/null";
  try {
    return run_child(command).exit_code == 0;
  } catch (const StartError&) {
    return false;
  }
}

int docs(const CostCommand& command) {
  const AccuracyMeasured measured{measure_cost(command.options, tell),
                                  measure_cost(options_of_cases(command.options), tell),
                                  measure_effects(command.options, has_program("valgrind"), tell)};
  write_files(measured.scenes, command.options.out);
  const fs::path folder = command.docs, pictures = folder / "accuracy";
  write_text(pictures / "cost.svg", scene_chart(all_scenes(measured.scenes)));
  write_text(pictures / "scenes.svg", scenes_chart(measured.scenes));
  write_text(pictures / "axes.svg", axes_chart(scene_for_axes(measured.scenes)));
  write_text(pictures / "effects.svg", effects_chart(measured.effects));
  write_text(folder / "accuracy.md", accuracy_page(measured));
  std::printf("%s is written anew\n", (folder / "accuracy.md").c_str());
  return kGood;
}

int cost(CostCommand command) {
  try {
    if (!command.docs.empty()) return docs(command);
    if (command.effects) return effects(command);
    command.options.axes = !command.no_axes;
    command.options.mesa = !command.no_mesa;
    const CostResult result = measure_cost(command.options, tell);
    std::fputs(to_text(result).c_str(), stdout);
    write_files(result, command.options.out);
    std::printf("cost.csv, cost.json and the charts cost*.svg are in %s\n", command.options.out.c_str());
    return kGood;
  } catch (const std::exception& error) {
    tell(error.what());
    return kCouldNotTell;
  }
}

void add_what_to_draw(CLI::App& app, CostOptions& options) {
  app.add_option("--scenes", options.scenes,
                 "Scenes of ref_app: numbers, ranges (2-5), names, or `everything`; default: all")
      ->delimiter(',');
  app.add_option("--cases", options.cases, "Hard cases by name, or all")->delimiter(',');
  app.add_option("--frame", options.frame, "Which frame of PROGRAM is judged, from 0")->capture_default_str();
  app.add_option("--size", "Picture size, WIDTHxHEIGHT; default 512x512")
      ->each([&options](const std::string& text) {
        int end = 0;
        if (std::sscanf(text.c_str(), "%5dx%5d%n", &options.width, &options.height, &end) != 2 ||
            static_cast<size_t>(end) != text.size() || options.width < 1 || options.height < 1)
          throw CLI::ValidationError("--size", "'" + text + "' is not a size like 512x512");
      });
}

void add_how_to_measure(CLI::App& app, CostCommand& command) {
  CostOptions& options = command.options;
  app.add_flag("--effects", command.effects,
               "Measure instead what each effect costs on a scene that they are added to one by one");
  app.add_flag("--instructions", command.instructions,
               "With --effects: also count the instructions of a frame, by valgrind");
  app.add_option("--docs", command.docs,
                 "Measure everything and write the page accuracy.md, with its pictures, into this folder")
      ->type_name("DIR");
  app.add_flag("--no-axes", command.no_axes, "The three levels only, no axis of the dial alone");
  app.add_flag("--no-mesa", command.no_mesa, "Leave OSMesa's llvmpipe and softpipe out");
  app.add_option("--rounds", options.rounds, "How often all settings take their turn")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app.add_option("--frames", options.frames, "Frames a process and scene")
      ->capture_default_str()
      ->check(CLI::Range(1, 10000));
  app.add_option("--core", options.core, "Core all are pinned to; default: the last one");
  app.add_option("--library", options.folders.ours, "Folder that holds our libOSMesa.so.8")->type_name("DIR");
  app.add_option("--oracle", options.folders.oracle, "Folder that holds the oracle's libOSMesa.so.8")
      ->type_name("DIR");
  app.add_option("--out", options.out, "Folder for tables and charts")->capture_default_str();
}

}  // namespace

void add_cost_command(CLI::App& app, const std::vector<std::string>& program, int& status) {
  auto command = std::make_shared<CostCommand>();
  CLI::App* cost_app = app.add_subcommand(
      "cost",
      "Time each step of accuracy, and count the pixels it gets right: halfspace cost [OPTIONS] [-- PROGRAM [ARGUMENTS...]]");
  cost_app->footer(
      "Time is the processor's, on one thread; the truth is drawn by the oracle, a slow renderer of the tests, and\n"
      "kept in OUT/truth. PROGRAM is run again and again, so it has to end by itself and draw the same each time: record\n"
      "one that does not with `apitrace trace`, and give `-- glretrace -b FILE.trace`.\n"
      "Exit status: 0 measured, whatever came out; 1 an effect that was off did something (--effects); 2 something\n"
      "could not be drawn.");
  add_what_to_draw(*cost_app, command->options);
  add_how_to_measure(*cost_app, *command);
  cost_app->prefix_command();
  cost_app->callback([command, cost_app, &program, &status] {
    command->options.program = cost_app->remaining();
    if (!command->options.program.empty() && command->options.program.front().starts_with("-"))
      throw CLI::ValidationError(command->options.program.front(),
                                 "is no option of ours; see halfspace cost --help");
    command->options.program.insert(command->options.program.end(), program.begin(), program.end());
    status = cost(*command);
  });
}

}  // namespace halfspace::compare
