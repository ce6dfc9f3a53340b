// halfspace demo: the eight scenes, ours beside OSMesa's, as a report.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "compare/commands.h"
#include "compare/demo.h"
#include "compare/html.h"

namespace halfspace::compare {
namespace {

int demo(const DemoOptions& options, bool again) {
  try {
    const auto progress = [](const std::string& what) {
      std::fprintf(stderr, "halfspace demo: %s\n", what.c_str());
    };
    const Demo result = again ? load_demo(options.out) : run_demo(options, progress);
    std::fputs(to_text(result).c_str(), stdout);
    progress("writing the report");
    write_text(options.out / "demo.json", to_json(result).dump(2) + "\n");
    write_text(options.out / "report.html", demo_report(result, options.gain));
    std::printf("\nreport: %s\n", std::filesystem::absolute(options.out / "report.html").c_str());
    return kGood;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "halfspace demo: %s\n", error.what());
    return kCouldNotTell;
  }
}

}  // namespace

void add_demo_command(CLI::App& app, int& status) {
  auto options = std::make_shared<DemoOptions>();
  auto again = std::make_shared<bool>(false);
  CLI::App* command =
      app.add_subcommand("demo", "Draw the eight scenes with ours and with OSMesa, and compare");
  command->footer("Exit status: 0 the report was written, whatever it says; 2 something could not be drawn.");
  command->add_option("--scene", options->scenes, "Only this scene; may be repeated")
      ->check(CLI::Range(1, kSceneCount));
  command->add_option("--frames", options->frames, "Frames a scene")
      ->capture_default_str()
      ->check(CLI::Range(1, 10000));
  command->add_option("--gain", options->gain, "How much differences are amplified")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option("--library", options->library, "Folder that holds our libOSMesa.so.8")
      ->type_name("DIR");
  command->add_option("--out", options->out, "Folder for pictures and report.html")->capture_default_str();
  command->add_flag("--again", *again, "Write the report anew from the pictures of before");
  command->callback([options, again, &status] { status = demo(*options, *again); });
}

}  // namespace halfspace::compare
