// The oracle's frames: what a picture is measured against.
#pragma once

#include <string>
#include <vector>

#include "stage.h"

namespace halfspace::hard {

// One pixel as the oracle knows it.
struct TruePixel {
  float rgba[4];       // levels, 0 .. 255, not rounded
  uint32_t owner = 0;  // the last primitive of the frame that wrote it, from 1; 0: none
  uint32_t draw = 0;   // that primitive's draw, from 1
  double depth = 0;    // 0 .. 2^24 - 1, not rounded
};

struct Truth {
  int width = 0, height = 0;
  std::vector<TruePixel> pixels;
};

// Throws std::runtime_error when the file is none of the oracle's.
Truth read_truth(const std::string& path);

struct Error {
  double color = 0;       // levels, largest
  double depth = 0;       // units of 2^-24, largest
  size_t interior = 0;    // pixels all of whose neighbours show the same primitive: those above
  size_t edge_wrong = 0;  // of the others, those that differ by a level or more: another primitive's colour
};

Error measure(const Picture& picture, const Truth& truth);

}  // namespace halfspace::hard
