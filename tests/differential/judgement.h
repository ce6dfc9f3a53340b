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
  std::vector<Owner> owner;  // row 0 is the bottom row
};

// A pixel that shows another primitive than it should. Coordinates as GL has them: y up.
struct Misplaced {
  int x = 0, y = 0;
  Owner drawn = 0, truth = 0;
  double edge_distance = 0;  // from the pixel's centre to the nearest edge of either, pixels
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

// Throws std::runtime_error when the sizes do not agree. `recording` is what `truth` was made from.
Judgement judge(const Recording& recording, const Truth& truth, const Drawn& drawn);

// The truths a scene has by one filter.
struct Truths {
  Truth snapped, ideal;
  const Truth& contract() const { return kContract == Positions::snapped ? snapped : ideal; }
};

// Our picture against another renderer's, each differing pixel under the first reason that applies.
struct Disagreement {
  double max = 0, max_interior = 0;  // levels
  uint64_t differing = 0;            // pixels
  uint64_t misplaced = 0;            // ... of which one of the two shows another primitive than it should
  uint64_t ours_wrong = 0;           // ... ours is not the truth by contract, rounded
  uint64_t corners =
      0;  // ... the other's is the truth by snapped or by ideal corners, rounded: both are right
  uint64_t theirs_wrong = 0;  // ... the other's is neither truth
};
Disagreement between(const Truths& truths, const Drawn& ours, const Drawn& theirs);

}  // namespace halfspace::differential
