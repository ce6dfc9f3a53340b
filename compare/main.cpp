// halfspace: compares pictures, runs programs on our libGL, measures, reports.
#include <CLI/CLI.hpp>

#include "compare/commands.h"

int main(int argc, char** argv) {
  using namespace halfspace::compare;
  int status = kGood;
  CLI::App app{"Halfspace: a software OpenGL 1.x. Pictures compared, programs run, time measured."};
  app.set_version_flag("--version", "halfspace " HALFSPACE_VERSION);
  app.require_subcommand(1);
  add_compare_command(app, status);
  add_run_command(app, status);
  add_demo_command(app, status);
  add_bench_command(app, status);
  add_cost_command(app, status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kGood : kCouldNotTell;
  }
  return status;
}
