// Child processes: started with an environment and on cores of our choosing, and waited for.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace halfspace::compare {

// The program could not be started; `error_number` is the errno of the attempt.
struct StartError : std::runtime_error {
  StartError(const std::string& what, int error_number_)
      : std::runtime_error(what), error_number(error_number_) {}
  int error_number;
};

using EnvironmentVariable = std::pair<std::string, std::string>;

struct ChildCommand {
  std::vector<std::string> arguments;            // arguments[0] is looked up in PATH
  std::vector<EnvironmentVariable> environment;  // set on top of ours; an empty value unsets
  std::vector<int> cores;                        // empty: as we are
  std::filesystem::path output;                  // stdout and stderr go to this file; empty: to ours
};

struct ChildResult {
  int exit_code = 0;  // 128 + signal when a signal ended it, as a shell has it
  int signal = 0;
  double seconds = 0;      // from before fork to its end
  double cpu_seconds = 0;  // processor time, the system's for it too
};

// Runs to the end. SIGINT and SIGTERM sent to us meanwhile are handed on to the child. Throws StartError.
ChildResult run_child(const ChildCommand& command);

// Becomes the program. Returns only by StartError.
[[noreturn]] void become(const ChildCommand& command);

// The exit status a shell gives for a program that cannot be started: 127 not found, 126 not executable.
int shell_status(const StartError& error);

// The cores this process may run on, lowest first.
std::vector<int> available_cores();
// `wish`, or the last of them for -1.
int core_to_use(int wish);

}  // namespace halfspace::compare
