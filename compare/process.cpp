#include "compare/process.h"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>

#include "compare/prepared_command.h"

namespace halfspace::compare {
namespace {

std::atomic<pid_t> running_child{0};

void hand_on(int signal_number) {
  const pid_t child = running_child.load();
  if (child > 0) kill(child, signal_number);
}

// While it lives, SIGINT and SIGTERM go to the child instead of ending us, so that captured frames are not
// lost.
class HandOnSignals {
 public:
  HandOnSignals() {
    struct sigaction action {};
    action.sa_handler = hand_on;
    for (size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &action, &before_[i]);
  }
  ~HandOnSignals() {
    for (size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  }
  HandOnSignals(const HandOnSignals&) = delete;
  HandOnSignals& operator=(const HandOnSignals&) = delete;

 private:
  static constexpr std::array<int, 2> kSignals{SIGINT, SIGTERM};
  std::array<struct sigaction, 2> before_{};
};

// The child writes its errno here when exec fails; a successful exec closes it.
class ErrorPipe {
 public:
  ErrorPipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0) throw StartError("no pipe to be had", errno);
  }
  ~ErrorPipe() {
    close_write();
    close(ends_[0]);
  }
  ErrorPipe(const ErrorPipe&) = delete;
  ErrorPipe& operator=(const ErrorPipe&) = delete;

  void send(int number) const { (void)!write(ends_[1], &number, sizeof number); }
  void close_write() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }
  int receive() {
    close_write();
    int number = 0;
    ssize_t got = 0;
    do got = read(ends_[0], &number, sizeof number);
    while (got < 0 && errno == EINTR);
    return got == sizeof number ? number : 0;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

int wait_for(pid_t child, ChildResult& result) {
  int status = 0;
  rusage used{};
  while (wait4(child, &status, 0, &used) < 0 && errno == EINTR) {
  }
  result.cpu_seconds = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  return status;
}

}  // namespace

ChildResult run_child(const ChildCommand& command) {
  const PreparedCommand prepared(command);
  ErrorPipe error_pipe;
  const auto start = std::chrono::steady_clock::now();
  // Not fork(): to copy this process's page tables takes milliseconds, which would count as the program's start.
  const pid_t child = vfork();
  if (child < 0) throw start_error(command, errno);
  if (child == 0) {
    error_pipe.send(prepared.exec());
    _exit(127);
  }
  running_child = child;
  const HandOnSignals hand_on_signals;
  const int exec_error = error_pipe.receive();
  ChildResult result;
  const int status = wait_for(child, result);
  running_child = 0;
  if (exec_error != 0) throw start_error(command, exec_error);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  result.exit_code = result.signal != 0 ? 128 + result.signal : WEXITSTATUS(status);
  return result;
}

void become(const ChildCommand& command) {
  const PreparedCommand prepared(command);
  throw start_error(command, prepared.exec());
}

int shell_status(const StartError& error) { return error.error_number == ENOENT ? 127 : 126; }

std::vector<int> available_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> cores;
  if (sched_getaffinity(0, sizeof set, &set) == 0)
    for (int core = 0; core < CPU_SETSIZE; ++core)
      if (CPU_ISSET(static_cast<unsigned>(core), &set)) cores.push_back(core);
  return cores;
}

int core_to_use(int wish) {
  if (wish >= 0) return wish;
  const std::vector<int> cores = available_cores();
  return cores.empty() ? 0 : cores.back();
}

}  // namespace halfspace::compare
