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

Dialogue::~Dialogue() {
  close(to_child_);
  close(from_child_);
  while (waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::string Dialogue::ask(const std::string& line) {
  bool alive = write_all(to_child_, line + "\n");
  for (size_t end; alive;) {
    if ((end = received_.find('\n')) != std::string::npos) {
      const std::string answer = received_.substr(0, end);
      received_.erase(0, end + 1);
      return answer;
    }
    std::array<char, 4096> buffer;
    const ssize_t count = read(from_child_, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    alive = count > 0;
    if (alive) received_.append(buffer.data(), static_cast<size_t>(count));
  }
  throw std::runtime_error(name_ + " ended instead of answering \"" + line + "\"");
}

}  // namespace halfspace::compare
