// A frame's truth as the oracle left it (tests/oracle/truth_file.h).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace halfspace::differential {

struct TruePixel {
  std::array<float, 4> level{};          // R, G, B, A, 0 .. 255, before rounding
  std::array<uint8_t, 4> low{}, high{};  // what may be stored
  uint32_t owner = 0, draw = 0;          // from 1; 0: the background
  double depth = 0;                      // 0 .. 2^24 - 1
  bool doubtful = false;                 // rounding may decide what is to be seen
};

struct TrueFrame {
  int width = 0, height = 0;
  std::vector<TruePixel> pixels;  // bottom row first
  const TruePixel& at(int x, int y) const {
    return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
};

// Stems of the frames in a folder, in order.
std::vector<std::string> frames_in(const std::string& directory);
// The last frame in a folder; throws std::runtime_error when there is none.
TrueFrame read_last_frame(const std::string& directory);
// `stem`: without .truth or .bounds.
TrueFrame read_frame(const std::string& stem);
void remove_frames(const std::string& directory);

}  // namespace halfspace::differential
