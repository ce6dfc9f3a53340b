// A drawn picture held against the true one.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compare/image.h"
#include "tests/differential/truth.h"

namespace halfspace::differential {

// A picture as a renderer left it.
struct Drawn {
  compare::Image picture;    // row 0 is the top row
  std::vector<Owner> owner;  // row 0 is the bottom row; empty: nobody asked
};

// A pixel that shows another primitive than it should. Coordinates as GL has them: y up.
struct Misplaced {
  int x = 0, y = 0;
  Owner drawn = 0, truth = 0;
  double edge_distance = 0;  // of the true owner's triangle, pixels
};

struct WorstColor {
  int x = 0, y = 0;
  double levels = 0;
};

// Colours are judged where the right primitive shows, on all of R, G, B, A.
struct Judgement {
  uint64_t pixels = 0;
  uint64_t interior_pixels = 0;
  uint64_t wrong_pixels = 0;  // some byte is not the truth correctly rounded (a tie may go either way)
  uint64_t wrong_bytes = 0;
  WorstColor worst, worst_interior;  // |byte - truth|; a perfect picture stays below 0.5
  std::vector<Misplaced> misplaced;

  double wrong_percent() const { return 100.0 * double(wrong_pixels) / double(pixels); }
};

// Throws std::runtime_error when the sizes do not agree.
Judgement judge(const Truth& truth, const Drawn& drawn);

// Two pictures against each other, with the truth as arbiter of what is inside and who is right.
struct Disagreement {
  uint64_t differing = 0;            // pixels
  uint64_t first_right = 0;          // ... where the first shows the true colour rounded, the second not
  uint64_t second_right = 0;         // ... the other way round
  double max = 0, max_interior = 0;  // levels, between the two
};
Disagreement between(const Truth& truth, const compare::Image& first, const compare::Image& second);

}  // namespace halfspace::differential
