// All that exec needs, made before the fork: between fork and exec nothing may allocate.
#pragma once

#include <sched.h>

#include "compare/process.h"

namespace halfspace::compare {

class PreparedCommand {
 public:
  explicit PreparedCommand(const ChildCommand& command);
  PreparedCommand(const PreparedCommand&) = delete;
  PreparedCommand& operator=(const PreparedCommand&) = delete;

  // Returns the errno when it fails.
  int exec() const;

 private:
  std::vector<std::string> arguments_, environment_;
  std::vector<char*> argument_list_, environment_list_;
  std::string output_;
  bool pinned_;
  cpu_set_t cores_{};
};

// What to throw when `command` could not be started for the reason `number`, an errno.
StartError start_error(const ChildCommand& command, int number);

}  // namespace halfspace::compare
