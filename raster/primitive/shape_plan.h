// What a draw's points, lines and polygons ask for beyond one pixel and solid fill, worked out once a draw.
#pragma once

#include "raster/api/draw_state.h"

namespace halfspace::raster {

struct ShapePlan {
  bool general = false;   // the draw takes raster/primitive/shape_assembly.cpp's way
  bool coverage = false;  // fragments may be covered in part: smooth points, lines or polygons
  // Polygons: sizes of their points and lines are those below.
  bool smooth_polygons = false, smooth_lines = false, smooth_points = false;
  bool stippled_lines = false;
  bool offset_fill = false;
  int point_size = 1, line_width = 1;                   // pixels, where not smooth
  double smooth_point_size = 1, smooth_line_width = 1;  // pixels
  // Of smooth ones.
  Level point_coverage = Level::standard, line_coverage = Level::standard, polygon_coverage = Level::standard;

  bool plain_lines() const { return line_width == 1 && !smooth_lines && !stippled_lines; }
};

ShapePlan plan_shapes(const DrawState& state, Primitive mode);

// Polygon offset (spec 3.5.5) in steps of the depth buffer, r being one step: factor * slope + units. slope:
// the greater of |dz/dx| and |dz/dy|, in steps per pixel. Held to twice the depth range, beyond which nothing
// changes.
double depth_offset(const PolygonState& polygon, double slope);

// Whether a polygon drawn in `mode` is offset (spec 3.5.5).
inline bool is_offset(const PolygonState& polygon, PolygonMode mode) {
  if (mode == PolygonMode::fill) return polygon.offset_fill;
  return mode == PolygonMode::line ? polygon.offset_line : polygon.offset_point;
}

}  // namespace halfspace::raster
