// The subcommands of `halfspace`. Each function adds one to the command line; its callback runs it and sets
// `status`, which becomes the exit status.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace halfspace::compare {

// Exit statuses shared by the subcommands that judge: as diff and grep have them.
constexpr int kGood = 0;
constexpr int kLimitBroken = 1;
constexpr int kCouldNotTell = 2;

void add_compare_command(CLI::App& app, int& status);
// `program`: the words after a lone --, which CLI11 does not hand on.
void add_run_command(CLI::App& app, const std::vector<std::string>& program, int& status);
void add_demo_command(CLI::App& app, int& status);
void add_bench_command(CLI::App& app, int& status);
void add_cost_command(CLI::App& app, const std::vector<std::string>& program, int& status);

}  // namespace halfspace::compare
