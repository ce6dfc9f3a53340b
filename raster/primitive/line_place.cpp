#include "raster/primitive/line_place.h"

#include <algorithm>
#include <cmath>

namespace halfspace::raster {
namespace {

// What snapping took away along one axis, sub-pixels: the viewport's place, an integer, has no part in it. A
// coordinate that was held to the guard band has nothing to give back.
double rest_of(double clip, double w, double scale, double offset, int32_t snapped) {
  const double rest = clip / w * scale - (snapped - offset);
  return std::abs(rest) <= 0.5 ? rest : 0;
}

}  // namespace

LinePlace::LinePlace(const WindowTransform& t, const LineSpan& l, bool along_major) {
  const double rest_ax = rest_of(l.a.x, l.a.w, t.scale_x, t.offset_x, l.ax),
               rest_ay = rest_of(l.a.y, l.a.w, t.scale_y, t.offset_y, l.ay);
  const double rest_bx = rest_of(l.b.x, l.b.w, t.scale_x, t.offset_x, l.bx),
               rest_by = rest_of(l.b.y, l.b.w, t.scale_y, t.offset_y, l.by);
  const double snapped_x = l.bx - l.ax, snapped_y = l.by - l.ay;
  const double x = snapped_x + (rest_bx - rest_ax), y = snapped_y + (rest_by - rest_ay);
  // Lengths are |x| + |y|; the longest side of the triangle is the one across.
  const double length = std::abs(x) + std::abs(y), half_area = (x * x + y * y) / 2;
  const double inv_a = 1 / l.a.w, inv_b = 1 / l.b.w;
  const bool leaves_grid = 2 * std::max(std::abs(x), std::abs(y)) <= half_area &&
                           std::abs(inv_b - inv_a) * length <= std::min(inv_a, inv_b) * half_area;
  constexpr double kPixel = 1.0 / kSubpixelScale;
  dx_ = (leaves_grid ? x : snapped_x) * kPixel, dy_ = (leaves_grid ? y : snapped_y) * kPixel;
  rest_x_ = leaves_grid ? rest_ax * kPixel : 0, rest_y_ = leaves_grid ? rest_ay * kPixel : 0;
  // By the snapped ends, as the pixels are found.
  if (along_major) (std::abs(snapped_y) > std::abs(snapped_x) ? dx_ : dy_) = 0;
}

Plane LinePlace::along(double f0, double f1) const {
  const double square = dx_ * dx_ + dy_ * dy_;
  const double per_length = square > 0 ? (f1 - f0) / square : 0;
  const double dfdx = dx_ * per_length, dfdy = dy_ * per_length;
  return {f0 - (dfdx * rest_x_ + dfdy * rest_y_), dfdx, dfdy};
}

}  // namespace halfspace::raster
