#include "compare/prepared_command.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace halfspace::compare {
namespace {

bool overrides(const std::vector<EnvironmentVariable>& changes, const char* entry) {
  for (const auto& [name, value] : changes)
    if (std::strncmp(entry, name.c_str(), name.size()) == 0 && entry[name.size()] == '=') return true;
  return false;
}

std::vector<std::string> merged_environment(const std::vector<EnvironmentVariable>& changes) {
  std::vector<std::string> merged;
  for (char** entry = environ; *entry != nullptr; ++entry)
    if (!overrides(changes, *entry)) merged.emplace_back(*entry);
  for (const auto& [name, value] : changes)
    if (!value.empty()) merged.push_back(name + "=" + value);
  return merged;
}

std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> list;
  for (std::string& text : strings) list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}

}  // namespace

PreparedCommand::PreparedCommand(const ChildCommand& command)
    : arguments_(command.arguments),
      environment_(merged_environment(command.environment)),
      argument_list_(pointers(arguments_)),
      environment_list_(pointers(environment_)),
      output_(command.output.string()),
      pinned_(!command.cores.empty()) {
  CPU_ZERO(&cores_);
  for (int core : command.cores) CPU_SET(static_cast<unsigned>(core), &cores_);
}

int PreparedCommand::exec() const {
  if (pinned_ && sched_setaffinity(0, sizeof cores_, &cores_) != 0) return errno;
  if (!output_.empty()) {
    const int file = open(output_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0 || dup2(file, STDOUT_FILENO) < 0 || dup2(file, STDERR_FILENO) < 0) return errno;
  }
  execvpe(argument_list_[0], argument_list_.data(), environment_list_.data());
  return errno;
}

StartError start_error(const ChildCommand& command, int number) {
  return {command.arguments.front() + ": cannot be started: " + std::strerror(number), number};
}

}  // namespace halfspace::compare
