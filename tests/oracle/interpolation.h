// Values between the corners of a triangle, from the formulas of spec 3.5.1.
#pragma once

#include <array>
#include <cmath>

#include "tests/oracle/coverage.h"

namespace halfspace::oracle {

// An affine function of window position: value at a pixel's centre and its change per pixel.
template <typename Real>
struct Affine {
  Real value, dx, dy;
};

template <typename Real>
struct Position {
  Real x, y;  // pixels
};

// The affine function through `values` at three corners, at the centre of (px, py). The triangle has area.
template <typename Real>
Affine<Real> affine(const std::array<Position<Real>, 3>& t, const std::array<Real, 3>& values, int px,
                    int py) {
  const Real x1 = t[1].x - t[0].x, y1 = t[1].y - t[0].y;
  const Real x2 = t[2].x - t[0].x, y2 = t[2].y - t[0].y;
  const Real area = x1 * y2 - x2 * y1;
  const Real v1 = values[1] - values[0], v2 = values[2] - values[0];
  const Real dx = (v1 * y2 - v2 * y1) / area;
  const Real dy = (v2 * x1 - v1 * x2) / area;
  const Real x = Real(px) + Real(0.5) - t[0].x, y = Real(py) + Real(0.5) - t[0].y;
  return {values[0] + dx * x + dy * y, dx, dy};
}

// The same for corners on the grid.
template <typename Real>
Affine<Real> affine(const SnappedTriangle& t, const std::array<Real, 3>& values, int px, int py) {
  std::array<Position<Real>, 3> corners;
  for (size_t i = 0; i < 3; ++i) corners[i] = {Real(t[i].x) / Real(256), Real(t[i].y) / Real(256)};
  return affine(corners, values, px, py);
}

// A quotient of two affine functions with its derivatives: a perspective-correct value (spec 3.5.1,
// equation 3.6) is quotient(affine(value / w), affine(1 / w)).
template <typename Real>
Affine<Real> quotient(const Affine<Real>& a, const Affine<Real>& b) {
  const Real value = a.value / b.value;
  return {value, (a.dx - value * b.dx) / b.value, (a.dy - value * b.dy) / b.value};
}

}  // namespace halfspace::oracle
