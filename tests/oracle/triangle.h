// A triangle given in clip coordinates, as the specification draws it when nothing of it has to be clipped.
#pragma once

#include <array>

#include "raster/api/draw_state.h"
#include "tests/oracle/interpolation.h"

namespace halfspace::oracle {

struct ClipPoint {
  double x = 0, y = 0, z = 0, w = 1;
};

class Triangle {
 public:
  // All w > 0. Window coordinates by spec 2.10.1. Coverage takes them snapped; depth, 1/w and attributes
  // belong to the corners before snapping, unless a covered pixel could then lie too far outside: where half
  // a sub-pixel changes a barycentric coordinate, or 1/w in parts of its least value, by more than a quarter,
  // they belong to the snapped ones.
  Triangle(const raster::Viewport& viewport, const std::array<ClipPoint, 3>& corners);

  const SnappedTriangle& corners() const { return corners_; }
  bool covers(int px, int py) const { return oracle::covers(corners_, px, py); }
  // Window depth in [0, 1].
  long double depth(int px, int py) const { return affine(planes_, depth_, px, py).value; }
  // A perspective-correct attribute with its window derivatives.
  Affine<long double> attribute(const std::array<long double, 3>& values, int px, int py) const;
  // The same for value / q, as texture coordinates s and t are (spec 3.5.1).
  Affine<long double> projected(const std::array<long double, 3>& values, const std::array<long double, 3>& q,
                                int px, int py) const;

 private:
  Affine<long double> over_w(const std::array<long double, 3>& values, int px, int py) const;

  bool may_leave_grid(const std::array<Position<long double>, 3>& ideal) const;

  SnappedTriangle corners_;
  std::array<Position<long double>, 3> planes_;  // the corners attributes belong to
  std::array<long double, 3> depth_, inv_w_;
};

}  // namespace halfspace::oracle
