// A player process with one libOSMesa in it, started again when it dies.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "call.h"

namespace halfspace::fuzz {

struct Picture {
  int width = 0, height = 0;
  std::vector<uint8_t> rgba;    // bottom row first
  std::vector<uint32_t> depth;  // of our library: 0 .. 2^24 - 1
};

// What a glRenderMode that left selection or feedback brought.
struct Capture {
  uint32_t call = 0;
  uint32_t mode = 0;            // GL_SELECT or GL_FEEDBACK
  uint32_t type = 0;            // of the feedback buffer
  int32_t result = 0;           // what glRenderMode returned
  std::vector<uint32_t> words;  // of the buffer, as far as they were written; floats by their bits
};

struct Outcome {
  // "" if all went well, else how the player ended.
  std::string trouble;
  Picture picture;
  // (index of the call, GL error)
  std::vector<std::pair<uint32_t, uint32_t>> errors;
  // At the end, bottom row first.
  std::vector<float> depth;
  std::vector<uint8_t> stencil;
  std::vector<Capture> captures;
};

class Renderer {
 public:
  // `driver`: GALLIUM_DRIVER for Mesa's library, "" for ours.
  Renderer(std::string player, std::string library, std::string driver);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  Outcome render(const Stream& stream, int width, int height);

 private:
  void start();
  // How it ended.
  std::string stop();

  std::string player_, library_, driver_;
  int process_ = 0, to_ = -1, from_ = -1, rendered_ = 0;
};

}  // namespace halfspace::fuzz
