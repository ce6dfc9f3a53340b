// Which pixels lines of whole widths make fragments at (spec 3.4.1, 3.4.2).
#pragma once

#include <vector>

#include "raster/api/types.h"
#include "tests/oracle/outline.h"

namespace halfspace::oracle {

struct LinePixel {
  int x, y;
};

// The diamond-exit rule: a fragment wherever the segment, its ends moved by (-e, -e^2), meets the open
// diamond around a pixel's centre, unless it ends in it. In the order of the line.
std::vector<LinePixel> line_pixels(const Place<int64_t>& a, const Place<int64_t>& b);

// |dx| >= |dy|.
inline bool is_x_major(const Place<int64_t>& a, const Place<int64_t>& b) {
  const int64_t dx = b.x - a.x, dy = b.y - a.y;
  return (dx < 0 ? -dx : dx) >= (dy < 0 ? -dy : dy);
}

}  // namespace halfspace::oracle
