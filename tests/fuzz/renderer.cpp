#include "renderer.h"

#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "protocol.h"

namespace halfspace::fuzz {
namespace {

constexpr int kSecondsForAStream = 60;
// Mesa keeps what it compiled; a fresh process now and then bounds the memory.
constexpr int kStreamsForAProcess = 400;

// The player answers when it is done, so waiting for the first byte is waiting for all of it.
bool answers_in_time(int file) {
  pollfd wait{file, POLLIN, 0};
  int ready;
  do ready = poll(&wait, 1, kSecondsForAStream * 1000);
  while (ready < 0 && errno == EINTR);
  return ready > 0;
}

bool read_captures(int file, std::vector<Capture>& captures) {
  uint32_t count = 0;
  if (!read_all(file, &count, sizeof(count))) return false;
  captures.resize(count);
  for (Capture& capture : captures) {
    uint32_t head[5];
    if (!read_all(file, head, sizeof(head))) return false;
    capture = {head[0], head[1], head[2], static_cast<int32_t>(head[3]), std::vector<uint32_t>(head[4])};
    if (!read_all(file, capture.words.data(), capture.words.size() * sizeof(uint32_t))) return false;
  }
  return true;
}

}  // namespace

Renderer::Renderer(std::string player, std::string library, std::string driver)
    : player_(std::move(player)), library_(std::move(library)), driver_(std::move(driver)) {
  signal(SIGPIPE, SIG_IGN);
}

Renderer::~Renderer() { stop(); }

void Renderer::start() {
  int in[2], out[2];
  if (pipe(in) != 0 || pipe(out) != 0) throw std::runtime_error("no pipe");
  process_ = fork();
  if (process_ < 0) throw std::runtime_error("no process");
  if (process_ == 0) {
    dup2(in[0], STDIN_FILENO);
    dup2(out[1], STDOUT_FILENO);
    for (int file : {in[0], in[1], out[0], out[1]}) close(file);
    if (!driver_.empty()) setenv("GALLIUM_DRIVER", driver_.c_str(), 1);
    execl(player_.c_str(), player_.c_str(), library_.c_str(), nullptr);
    _exit(127);
  }
  close(in[0]);
  close(out[1]);
  to_ = in[1];
  from_ = out[0];
  rendered_ = 0;
}

std::string Renderer::stop() {
  if (process_ == 0) return "";
  close(to_);
  // A player that waits for a stream ends by itself at the end of its input.
  int status = 0;
  for (int i = 0; i < 200 && waitpid(process_, &status, WNOHANG) == 0; ++i) {
    if (i == 199) {
      kill(process_, SIGKILL);
      waitpid(process_, &status, 0);
      break;
    }
    usleep(10'000);
  }
  close(from_);
  process_ = 0;
  if (WIFSIGNALED(status)) return std::string("ended by ") + strsignal(WTERMSIG(status));
  return "ended with " + std::to_string(WEXITSTATUS(status));
}

Outcome Renderer::render(const Stream& stream, int width, int height) {
  if (process_ != 0 && rendered_ >= kStreamsForAProcess) stop();
  if (process_ == 0) start();
  ++rendered_;
  Outcome outcome;
  const std::vector<uint8_t> bytes = serialize(stream);
  const uint32_t header[3] = {static_cast<uint32_t>(width), static_cast<uint32_t>(height),
                              static_cast<uint32_t>(bytes.size())};
  uint32_t start[2] = {};
  const bool sent = write_all(to_, header, sizeof(header)) && write_all(to_, bytes.data(), bytes.size());
  if (sent && !answers_in_time(from_)) {
    kill(process_, SIGKILL);
    stop();
    outcome.trouble = "took more than " + std::to_string(kSecondsForAStream) + " s";
    return outcome;
  }
  if (!sent || !read_all(from_, start, sizeof(start)) || start[0] != kDone) {
    outcome.trouble = stop();
    return outcome;
  }
  outcome.errors.resize(start[1]);
  for (auto& [call, error] : outcome.errors) {
    uint32_t pair[2] = {};
    read_all(from_, pair, sizeof(pair));
    call = pair[0];
    error = pair[1];
  }
  Picture& picture = outcome.picture;
  const size_t pixels = size_t{header[0]} * header[1];
  picture = {width, height, std::vector<uint8_t>(4 * pixels), std::vector<uint32_t>(pixels)};
  outcome.depth.resize(pixels);
  outcome.stencil.resize(pixels);
  if (!read_all(from_, picture.rgba.data(), picture.rgba.size()) ||
      !read_all(from_, picture.depth.data(), pixels * sizeof(uint32_t)) ||
      !read_all(from_, outcome.depth.data(), sizeof(float) * pixels) ||
      !read_all(from_, outcome.stencil.data(), pixels) || !read_captures(from_, outcome.captures))
    outcome.trouble = stop();
  return outcome;
}

}  // namespace halfspace::fuzz
