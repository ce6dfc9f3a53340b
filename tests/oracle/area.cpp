#include "tests/oracle/area.h"

#include <algorithm>

namespace halfspace::oracle {
namespace {

std::vector<Point> cut(const std::vector<Point>& shape, const Point& a, const Point& b) {
  std::vector<Point> kept;
  const auto side = [&](const Point& p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
  for (size_t i = 0; i < shape.size(); ++i) {
    const Point &from = shape[i], &to = shape[(i + 1) % shape.size()];
    const Real d0 = side(from), d1 = side(to);
    if (d0 >= 0) kept.push_back(from);
    if ((d0 >= 0) == (d1 >= 0)) continue;
    const Real t = d0 / (d0 - d1);
    kept.push_back({from.x + (to.x - from.x) * t, from.y + (to.y - from.y) * t});
  }
  return kept;
}

Real area(const std::vector<Point>& p) {
  Real twice = 0;
  for (size_t i = 1; i + 1 < p.size(); ++i)
    twice += (p[i].x - p[0].x) * (p[i + 1].y - p[0].y) - (p[i].y - p[0].y) * (p[i + 1].x - p[0].x);
  return twice / 2;
}

// The integral of min(sqrt(r^2 - t^2), h) over t from 0 to x: the part of a quarter disc below h, x and h in
// [0, r].
Real quarter(Real x, Real h, Real r) {
  const auto under_arc = [r](Real t) {
    return (t * std::sqrt(r * r - t * t) + r * r * std::asin(t / r)) / 2;
  };
  const Real flat = std::sqrt(r * r - h * h);  // up to here the arc lies above h
  if (x <= flat) return x * h;
  return flat * h + under_arc(x) - under_arc(flat);
}

// Of the disc around the origin and the rectangle between it and (x, y), with the sign of x y.
Real corner(Real x, Real y, Real r) {
  const Real sign = (x < 0) != (y < 0) ? -1 : 1;
  return sign * quarter(std::min(std::fabs(x), r), std::min(std::fabs(y), r), r);
}

}  // namespace

Real polygon_area_in_pixel(const std::vector<Point>& polygon, int px, int py) {
  const Real x = px, y = py;
  std::vector<Point> shape{{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}};
  for (size_t i = 0; i < polygon.size() && shape.size() > 2; ++i)
    shape = cut(shape, polygon[i], polygon[(i + 1) % polygon.size()]);
  return area(shape);
}

Real disc_area_in_pixel(const Point& c, Real r, int px, int py) {
  const Real x0 = px - c.x, x1 = x0 + 1, y0 = py - c.y, y1 = y0 + 1;
  return corner(x1, y1, r) - corner(x0, y1, r) - corner(x1, y0, r) + corner(x0, y0, r);
}

}  // namespace halfspace::oracle
