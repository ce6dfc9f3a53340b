#include "tests/oracle/coverage.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

namespace halfspace::oracle {

namespace {

using Integer = boost::multiprecision::cpp_int;

// Twice the signed area of (a, b, c): positive when c is to the left of the way from a to b.
Integer area(const SnappedPoint& a, const SnappedPoint& b, const SnappedPoint& c) {
  return (Integer(b.x) - a.x) * (Integer(c.y) - a.y) - (Integer(b.y) - a.y) * (Integer(c.x) - a.x);
}

// For a triangle taken counter-clockwise, y up: its left edges go down, its top edge goes left.
bool owns_its_points(const SnappedPoint& a, const SnappedPoint& b) {
  return b.y < a.y || (b.y == a.y && b.x < a.x);
}

SnappedPoint center(int px, int py) { return {int64_t{px} * 256 + 128, int64_t{py} * 256 + 128}; }

}  // namespace

bool covers(const SnappedTriangle& triangle, int px, int py) {
  SnappedTriangle t = triangle;
  const Integer whole = area(t[0], t[1], t[2]);
  if (whole == 0) return false;
  if (whole < 0) std::swap(t[1], t[2]);
  for (size_t i = 0; i < 3; ++i) {
    const SnappedPoint &a = t[i], &b = t[(i + 1) % 3];
    const Integer side = area(a, b, center(px, py));
    if (side < 0 || (side == 0 && !owns_its_points(a, b))) return false;
  }
  return true;
}

std::vector<uint8_t> coverage(const SnappedTriangle& triangle, int width, int height) {
  std::vector<uint8_t> covered(size_t(width) * size_t(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) covered[size_t(y) * size_t(width) + size_t(x)] = covers(triangle, x, y);
  }
  return covered;
}

double distance_to_edge(const SnappedTriangle& triangle, int px, int py) {
  double nearest = 1e300;
  for (size_t i = 0; i < 3; ++i) {
    const SnappedPoint &a = triangle[i], &b = triangle[(i + 1) % 3];
    const double length = std::hypot(double(b.x - a.x), double(b.y - a.y));
    if (length == 0) continue;
    nearest = std::min(nearest, std::fabs(area(a, b, center(px, py)).convert_to<double>()) / length / 256);
  }
  return nearest;
}

int64_t snap(long double v) { return int64_t(std::floor(v * 256 + 0.5L)); }

}  // namespace halfspace::oracle
