// Which pixels a triangle covers, in integers of any size.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace halfspace::oracle {

// Window coordinates in 1/256 px, y up.
struct SnappedPoint {
  int64_t x = 0, y = 0;
  bool operator==(const SnappedPoint&) const = default;
};
using SnappedTriangle = std::array<SnappedPoint, 3>;

// The centre of pixel (px, py) is inside the triangle, or lies on an edge that owns it: a left edge, or a
// horizontal edge with the inside below (spec 3.5.1 asks for some rule that gives shared edges' centres to
// one triangle; Halfspace takes the left and the top edges, as seen on the screen). Either winding. A
// triangle without area covers nothing.
bool covers(const SnappedTriangle& triangle, int px, int py);

// One byte a pixel of [0, width) x [0, height): 1 covered.
std::vector<uint8_t> coverage(const SnappedTriangle& triangle, int width, int height);

// Distance from the pixel's centre to the nearest edge line, in pixels.
double distance_to_edge(const SnappedTriangle& triangle, int px, int py);

// floor(v * 256 + 1/2), the rule of the house for snapping; v in pixels.
int64_t snap(long double v);

}  // namespace halfspace::oracle
