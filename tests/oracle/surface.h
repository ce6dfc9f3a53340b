// What a primitive's fragments carry: depth, 1/w and values over w are planes over the window.
#pragma once

#include <optional>

#include "tests/oracle/interpolation.h"
#include "tests/oracle/outline.h"

namespace halfspace::oracle {

inline constexpr Real kDepthSteps = 16777215;  // of the 24-bit depth buffer

struct Plane {
  Wide base = 0, dx = 0, dy = 0;  // at the window's origin; a pixel
  Wide at(int px, int py) const { return base + dx * (wide(px) + wide(0.5)) + dy * (wide(py) + wide(0.5)); }
};

class Surface {
 public:
  // Spec 3.5.1: a value is the quotient of two functions that are affine over the window, sum(a_i f_i / w_i)
  // and sum(a_i / w_i). Through the whole triangle, also where only a cut part of it is drawn. `places`:
  // where the corners are taken to lie, 1/256 px; without, where they are. None: the triangle has no area.
  static std::optional<Surface> of_triangle(const std::array<Corner, 3>& corners,
                                            const raster::Viewport& viewport,
                                            const std::array<Place<int64_t>, 3>* places = nullptr);
  // Spec 3.4.1: along the segment from a to b, constant across it. `along_major`: by the place along the
  // longer axis alone, as the replicated fragments of a wide line are alike (spec 3.4.2.1).
  static Surface of_line(const Corner& a, const Corner& b, const Place<Wide>& at_a, const Place<Wide>& at_b,
                         bool along_major, const raster::Viewport& viewport);
  static Surface of_point(const Corner& corner, const raster::Viewport& viewport);

  // Spec 3.5.5: o = m * factor + r * units, in steps of the depth buffer; m here, r is one step.
  Real steepest_depth() const;
  void add_depth(Real steps) { depth_.base += wide(steps); }
  void set_depth(Real steps) { depth_ = {wide(steps), 0, 0}; }
  void set_value(ValuePlace place, Wide value);  // the same everywhere

  // 0 .. 2^24 - 1, unrounded.
  Real depth(int px, int py) const;
  Affine<Real> value(ValuePlace place, int px, int py) const;
  // s / q or t / q (spec 3.8, figure 3.10).
  Affine<Real> coord(ValuePlace place, int px, int py) const;

 private:
  Affine<Real> quotient(const Plane& above, const Plane& below, int px, int py) const;

  Plane depth_, inv_w_;
  std::array<Plane, kValues> over_w_;
  std::array<std::optional<Wide>, kValues> constant_;  // what does not vary comes out as it went in
};

// Whether a triangle's planes go through its corners as they were before snapping (the house's rule): unless
// half a sub-pixel changes a barycentric coordinate, or 1/w in parts of its least value, by more than a
// quarter.
bool may_leave_grid(const std::array<Corner, 3>& corners, const raster::Viewport& viewport,
                    const std::array<Place<int64_t>, 3>& snapped);
// The same of a line, as of the triangle it makes with a corner at right angles to it.
bool line_may_leave_grid(const Corner& a, const Corner& b, const raster::Viewport& viewport);

}  // namespace halfspace::oracle
