// Whether a picture is one that GL allows, as far as two other renderers tell.
#pragma once

#include <string>
#include <vector>

#include "renderer.h"

namespace halfspace::fuzz {

// GL leaves open where exactly an edge, a line or a texel boundary falls, and how many bits colours and
// filters have. So a pixel is explained by a picture if each of its components lies within what the picture
// has there and one pixel around, give or take `levels`.
std::vector<bool> explained(const Picture& picture, const Picture& by, int levels);

struct Limits {
  int levels = 4;
  // Pixels that may be left unexplained: corners where three colours meet in less than a pixel.
  int pixels = 6;
};

// Of smooth lines and points GL says what covers a pixel wholly or not at all, and leaves the rest to the
// renderer (spec 3.3, 3.4.2): it may be a quarter of it. The stipple of lines gets out of step with Mesa's,
// which counts lengths; that shows where lines cross.
Limits widened(const Limits& limits, const Stream& stream);

struct Verdict {
  bool agrees = true;
  int wrong = 0;                 // pixels
  int first_x = 0, first_y = 0;  // the lowest, leftmost of them
  std::string reason;
};

// Both references have to disagree with ours, where they agree with each other and all around, too: what one
// of them does alone is its own affair. Either way round, so that what is missing shows, too.
Verdict judge(const Outcome& ours, const Outcome& first, const Outcome& second, const Limits& limits);

}  // namespace halfspace::fuzz
