// A child process that takes orders: a line to its standard input, a line back from its standard output.
#pragma once

#include <sys/types.h>

#include <string>

#include "compare/process.h"

namespace halfspace::compare {

class Dialogue {
 public:
  // Throws StartError when there is no process to be had. That the program cannot be executed shows at the
  // first question.
  explicit Dialogue(const ChildCommand& command);
  // Ends the child's input and waits for its end.
  ~Dialogue();
  Dialogue(const Dialogue&) = delete;
  Dialogue& operator=(const Dialogue&) = delete;

  // Throws std::runtime_error when the child ended instead of answering.
  std::string ask(const std::string& line);
  // Ends the child's input, and gives what it still has to say. Throws std::runtime_error when it failed.
  std::string rest();

 private:
  bool receive();
  int wait();

  std::string name_;
  pid_t child_ = -1;
  int to_child_ = -1, from_child_ = -1;
  std::string received_;
};

}  // namespace halfspace::compare
