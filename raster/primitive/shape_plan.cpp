#include "raster/primitive/shape_plan.h"

#include <algorithm>
#include <cmath>

namespace halfspace::raster {
namespace {

// To the nearest, at least 1 (spec 3.3, 3.4.2: a width that rounds to 0 is 1). NaN: 1.
int whole_size(float size, float most) {
  const float held = size < most ? size : most;
  return held >= 1 ? int(std::floor(double(held) + 0.5)) : 1;
}

double smooth_size(float size, float most) {
  const double held = double(size < most ? size : most);
  return held >= 1 ? std::floor(held / kSizeGranularity + 0.5) * kSizeGranularity : 1;
}

bool is_polygon(Primitive mode) { return mode >= Primitive::triangles; }
bool is_line(Primitive mode) { return mode >= Primitive::lines && mode < Primitive::triangles; }

}  // namespace

ShapePlan plan_shapes(const DrawState& state, Primitive mode) {
  const PolygonState& polygon = state.polygon;
  const bool polygons = is_polygon(mode);
  const auto has = [&](PolygonMode m) { return polygons && (polygon.front == m || polygon.back == m); };
  const bool fills = has(PolygonMode::fill);
  const bool lines = is_line(mode) || has(PolygonMode::line);
  const bool points = mode == Primitive::points || has(PolygonMode::point);
  ShapePlan plan;
  plan.general = state.clip_planes.enabled != 0;
  if (fills) {
    plan.smooth_polygons = polygon.smooth;
    plan.offset_fill = polygon.offset_fill && (polygon.offset_factor != 0 || polygon.offset_units != 0);
    plan.general = plan.general || plan.smooth_polygons;
    plan.polygon_coverage = polygon.coverage.value_or(state.accuracy.coverage);
  }
  if (lines) {
    plan.smooth_lines = state.line.smooth;
    plan.stippled_lines = state.line.stipple && state.line.pattern != 0xffff;
    plan.line_width = whole_size(state.line.width, kMaxLineWidth);
    plan.smooth_line_width = smooth_size(state.line.width, kMaxLineWidth);
    plan.line_coverage = state.line.coverage.value_or(state.accuracy.coverage);
    plan.general = plan.general || polygons || !plan.plain_lines();
  }
  if (points) {
    plan.smooth_points = state.point.smooth;
    plan.point_size = whole_size(state.point.size, kMaxPointSize);
    plan.smooth_point_size = smooth_size(state.point.size, kMaxPointSize);
    plan.point_coverage = state.point.coverage.value_or(state.accuracy.coverage);
    plan.general = plan.general || polygons || plan.smooth_points || plan.point_size != 1;
  }
  plan.coverage = plan.smooth_polygons || plan.smooth_lines || plan.smooth_points;
  return plan;
}

double depth_offset(const PolygonState& polygon, double slope) {
  constexpr double kMost = 33554432;
  const double offset = double(polygon.offset_factor) * slope + double(polygon.offset_units);
  if (offset >= -kMost && offset <= kMost) return offset;
  if (offset > 0) return kMost;
  return offset < 0 ? -kMost : 0;  // NaN: none
}

}  // namespace halfspace::raster
