// halfspace: compares pictures, runs programs on our libGL, measures, reports.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "compare/commands.h"

namespace {

// run and cost take a program after a lone --: its words leave the command line, since whatever they are they
// are not ours to understand.
std::vector<std::string> take_program(std::vector<std::string>& words) {
  if (words.empty() || (words.front() != "run" && words.front() != "cost")) return {};
  const auto mark = std::find(words.begin(), words.end(), "--");
  if (mark == words.end()) return {};
  const std::vector<std::string> program(mark + 1, words.end());
  words.erase(mark, words.end());
  return program;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace halfspace::compare;
  int status = kGood;
  std::vector<std::string> words(argv + 1, argv + argc);
  const std::vector<std::string> program = take_program(words);
  CLI::App app{"Halfspace: a software OpenGL 1.x. Pictures compared, programs run, time measured.",
               "halfspace"};
  app.set_version_flag("--version", "halfspace " HALFSPACE_VERSION);
  app.require_subcommand(1);
  add_compare_command(app, status);
  add_run_command(app, program, status);
  add_demo_command(app, status);
  add_bench_command(app, status);
  add_cost_command(app, program, status);
  try {
    std::reverse(words.begin(), words.end());  // as CLI11 wants them
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kGood : kCouldNotTell;
  }
  return status;
}
