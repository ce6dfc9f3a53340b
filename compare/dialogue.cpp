#include "compare/dialogue.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "compare/prepared_command.h"

namespace halfspace::compare {
namespace {

using Pipe = std::array<int, 2>;

Pipe make_pipe(const ChildCommand& command) {
  Pipe ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw start_error(command, errno);
  return ends;
}

// False when the other side is gone.
bool write_all(int file, const std::string& text) {
  for (size_t done = 0; done < text.size();) {
    const ssize_t count = write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    done += static_cast<size_t>(count);
  }
  return true;
}

}  // namespace

Dialogue::Dialogue(const ChildCommand& command) : name_(command.arguments.front()) {
  const PreparedCommand prepared(command);
  // A child that has ended shows as a failed write.
  signal(SIGPIPE, SIG_IGN);
  const Pipe orders = make_pipe(command), answers = make_pipe(command);
  child_ = fork();
  if (child_ < 0) throw start_error(command, errno);
  if (child_ == 0) {
    if (dup2(orders[0], STDIN_FILENO) >= 0 && dup2(answers[1], STDOUT_FILENO) >= 0) prepared.exec();
    _exit(127);
  }
  close(orders[0]);
  close(answers[1]);
  to_child_ = orders[1];
  from_child_ = answers[0];
}

Dialogue::~Dialogue() { wait(); }

// Its exit status as waitpid gives it; 0 when it has been waited for.
int Dialogue::wait() {
  if (child_ < 0) return 0;
  close(to_child_);
  close(from_child_);
  int status = 0;
  while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  return status;
}

// False at the end.
bool Dialogue::receive() {
  std::array<char, 4096> buffer;
  ssize_t count = 0;
  do count = read(from_child_, buffer.data(), buffer.size());
  while (count < 0 && errno == EINTR);
  if (count > 0) received_.append(buffer.data(), static_cast<size_t>(count));
  return count > 0;
}

std::string Dialogue::ask(const std::string& line) {
  bool alive = write_all(to_child_, line + "\n");
  for (size_t end = 0; alive; alive = receive()) {
    if ((end = received_.find('\n')) == std::string::npos) continue;
    const std::string answer = received_.substr(0, end);
    received_.erase(0, end + 1);
    return answer;
  }
  throw std::runtime_error(name_ + " ended instead of answering \"" + line + "\"");
}

std::string Dialogue::rest() {
  close(to_child_);
  to_child_ = -1;
  while (receive()) {
  }
  if (wait() != 0) throw std::runtime_error(name_ + " failed");
  return std::move(received_);
}

}  // namespace halfspace::compare
