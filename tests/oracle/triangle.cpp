#include "tests/oracle/triangle.h"

namespace halfspace::oracle {

Triangle::Triangle(const raster::Viewport& viewport, const std::array<ClipPoint, 3>& corners) {
  using Real = long double;
  const auto real = [](double v) { return static_cast<Real>(v); };
  for (size_t i = 0; i < 3; ++i) {
    const ClipPoint& c = corners[i];
    const Real w = real(c.w);
    corners_[i].x = snap(viewport.x + (real(c.x) / w + 1) * viewport.width / 2);
    corners_[i].y = snap(viewport.y + (real(c.y) / w + 1) * viewport.height / 2);
    const Real near = real(viewport.depth_near), far = real(viewport.depth_far);
    depth_[i] = (far - near) / 2 * (real(c.z) / w) + (near + far) / 2;
    inv_w_[i] = 1 / w;
  }
}

Affine<long double> Triangle::over_w(const std::array<long double, 3>& values, int px, int py) const {
  std::array<long double, 3> divided;
  for (size_t i = 0; i < 3; ++i) divided[i] = values[i] * inv_w_[i];
  return affine(corners_, divided, px, py);
}

Affine<long double> Triangle::attribute(const std::array<long double, 3>& values, int px, int py) const {
  return projected(values, {1, 1, 1}, px, py);
}

Affine<long double> Triangle::projected(const std::array<long double, 3>& values,
                                        const std::array<long double, 3>& q, int px, int py) const {
  return quotient(over_w(values, px, py), over_w(q, px, py));
}

}  // namespace halfspace::oracle
