#include "tests/oracle/triangle.h"

#include <algorithm>
#include <cmath>

namespace halfspace::oracle {

Triangle::Triangle(const raster::Viewport& viewport, const std::array<ClipPoint, 3>& corners) {
  using Real = long double;
  const auto real = [](double v) { return static_cast<Real>(v); };
  std::array<Position<Real>, 3> ideal;
  for (size_t i = 0; i < 3; ++i) {
    const ClipPoint& c = corners[i];
    const Real w = real(c.w);
    ideal[i].x = viewport.x + (real(c.x) / w + 1) * viewport.width / 2;
    ideal[i].y = viewport.y + (real(c.y) / w + 1) * viewport.height / 2;
    corners_[i].x = snap(ideal[i].x);
    corners_[i].y = snap(ideal[i].y);
    const Real near = real(viewport.depth_near), far = real(viewport.depth_far);
    depth_[i] = (far - near) / 2 * (real(c.z) / w) + (near + far) / 2;
    inv_w_[i] = 1 / w;
  }
  const bool leave = may_leave_grid(ideal);
  for (size_t i = 0; i < 3; ++i)
    planes_[i] = leave ? ideal[i] : Position<Real>{Real(corners_[i].x) / 256, Real(corners_[i].y) / 256};
}

// Lengths are |x| + |y|: the most that half a sub-pixel along both axes can do.
bool Triangle::may_leave_grid(const std::array<Position<long double>, 3>& t) const {
  constexpr long double kHalfSubpixel = 1.0L / 512;
  const long double x1 = t[1].x - t[0].x, y1 = t[1].y - t[0].y, x2 = t[2].x - t[0].x, y2 = t[2].y - t[0].y;
  long double area = x1 * y2 - x2 * y1;
  const SnappedTriangle& s = corners_;
  if ((s[1].x - s[0].x) * (s[2].y - s[0].y) < (s[2].x - s[0].x) * (s[1].y - s[0].y)) area = -area;
  const long double longest = std::max({std::fabs(x1) + std::fabs(y1), std::fabs(x2) + std::fabs(y2),
                                        std::fabs(x2 - x1) + std::fabs(y2 - y1)});
  const long double w1 = inv_w_[1] - inv_w_[0], w2 = inv_w_[2] - inv_w_[0];
  const long double slope = std::fabs(w1 * y2 - w2 * y1) + std::fabs(w2 * x1 - w1 * x2);
  const long double least = std::min({inv_w_[0], inv_w_[1], inv_w_[2]});
  return longest * kHalfSubpixel <= area / 4 && slope * kHalfSubpixel <= least * area / 4;
}

Affine<long double> Triangle::over_w(const std::array<long double, 3>& values, int px, int py) const {
  std::array<long double, 3> divided;
  for (size_t i = 0; i < 3; ++i) divided[i] = values[i] * inv_w_[i];
  return affine(planes_, divided, px, py);
}

Affine<long double> Triangle::attribute(const std::array<long double, 3>& values, int px, int py) const {
  return projected(values, {1, 1, 1}, px, py);
}

Affine<long double> Triangle::projected(const std::array<long double, 3>& values,
                                        const std::array<long double, 3>& q, int px, int py) const {
  return quotient(over_w(values, px, py), over_w(q, px, py));
}

}  // namespace halfspace::oracle
