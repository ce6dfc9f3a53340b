// Where the ends of a line lie that its values belong to.
#pragma once

#include "raster/primitive/segment.h"
#include "raster/vertex/window_transform.h"

namespace halfspace::raster {

// Two ends in clip coordinates, and where they are snapped to, 16.8; w > 0. The first is the anchor of the
// planes.
struct LineSpan {
  ClipVertex a, b;
  int32_t ax, ay, bx, by;
};

// Values belong to the ends as they were before snapping, so that a line carries the same whatever cuts it;
// unless half a sub-pixel changes the line too much. PlaneMaker in raster/tile/setup.inl has that rule for
// triangles, and for lines that are not cut: this is it, for the corner at right angles that makes the line a
// triangle.
class LinePlace {
 public:
  // `along_major`: values depend on the place along the longer axis alone.
  LinePlace(const WindowTransform& window, const LineSpan& line, bool along_major);

  // f0 at the first end and f1 at the other; constant across the line (spec 3.4.1).
  Plane along(double f0, double f1) const;

 private:
  double dx_, dy_;          // from the first end to the other, pixels
  double rest_x_, rest_y_;  // from where the first end is snapped to, pixels
};

}  // namespace halfspace::raster
