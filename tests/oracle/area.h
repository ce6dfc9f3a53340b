// How much of a pixel a shape covers: what antialiasing multiplies alpha with
// (spec 3.3.1, 3.4.2.3, 3.5.6, 3.11).
#pragma once

#include <vector>

#include "tests/oracle/number.h"

namespace halfspace::oracle {

struct Point {
  Real x, y;  // pixels
};

// Of the pixel whose lower left corner is (px, py), by a convex polygon given counter-clockwise.
Real polygon_area_in_pixel(const std::vector<Point>& polygon, int px, int py);
// By a disc.
Real disc_area_in_pixel(const Point& center, Real radius, int px, int py);

}  // namespace halfspace::oracle
