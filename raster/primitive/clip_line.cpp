// A line that is cut: its two ends, and planes that vary along it alone.
#include <cmath>

#include "raster/primitive/clip.h"
#include "raster/primitive/clip_planes.h"
#include "raster/primitive/line_place.h"

namespace halfspace::raster {
namespace {

// A point of the line: position, and how much of it comes from each end (the weights' sum is 1).
struct LinePoint {
  ClipVertex clip;
  double weight[2];
  int64_t original;  // the vertex it is, or -1
};

LinePoint crossing_point(const LinePoint& in, double d_in, const LinePoint& out, double d_out) {
  return {crossing(in.clip, d_in, out.clip, d_out),
          {crossing(in.weight[0], d_in, out.weight[0], d_out),
           crossing(in.weight[1], d_in, out.weight[1], d_out)},
          -1};
}

bool cut_line(const ClipPlane& plane, LinePoint (&p)[2]) {
  const double d[2] = {distance(plane, p[0].clip), distance(plane, p[1].clip)};
  if (d[0] < 0 && d[1] < 0) return false;
  if (d[0] < 0) p[0] = crossing_point(p[1], d[1], p[0], d[0]);
  if (d[1] < 0) p[1] = crossing_point(p[0], d[0], p[1], d[1]);
  return p[0].clip.w > 0 && p[1].clip.w > 0;
}

void place(const LinePoint& p, const DrawRecord& draw, const WindowTransform& t, int32_t& x, int32_t& y) {
  if (p.original >= 0) {
    x = draw.vertices.head(uint32_t(p.original)).x;
    y = draw.vertices.head(uint32_t(p.original)).y;
    return;
  }
  x = snap_coordinate(p.clip.x, p.clip.w, t.scale_x, t.offset_x);
  y = snap_coordinate(p.clip.y, p.clip.w, t.scale_y, t.offset_y);
}

bool is_finite(const Plane& p) {
  return std::isfinite(p.f0) && std::isfinite(p.dfdx) && std::isfinite(p.dfdy);
}

}  // namespace

bool Clipper::clip_line(const uint32_t v[2], unsigned outcodes, CutTriangle& out, PlaneSource& planes) const {
  const ShadedVertices& vertices = draw_.vertices;
  ClipPlane clip_planes[kClipPlanes];
  make_clip_planes(window_, clip_planes);
  LinePoint p[2] = {{vertices.clip[v[0]], {1, 0}, int64_t{v[0]}},
                    {vertices.clip[v[1]], {0, 1}, int64_t{v[1]}}};
  for (const ClipPlane& plane : clip_planes) {
    if ((outcodes & plane.outcode) && !cut_line(plane, p)) return false;
  }
  for (int i = 0; i < 2; ++i) place(p[i], draw_, window_, out.x[i], out.y[i]);
  out.x[2] = out.x[1], out.y[2] = out.y[1];
  if (out.x[0] == out.x[1] && out.y[0] == out.y[1]) return false;

  const bool swap = out.y[0] != out.y[1] ? out.y[1] < out.y[0] : out.x[1] < out.x[0];
  const LinePoint &a = p[swap], &b = p[!swap];  // the anchor is the lower end, so direction changes no bit
  planes.x0 = out.x[swap], planes.y0 = out.y[swap];
  const LinePlace placed(window_, {a.clip, b.clip, planes.x0, planes.y0, out.x[!swap], out.y[!swap]}, false);
  planes.provoking = v[1];
  const auto depth = [&](const LinePoint& q) {
    return q.clip.z / q.clip.w * window_.depth_scale + window_.depth_offset;
  };
  planes.planes[0] = placed.along(depth(a), depth(b));
  planes.planes[1] = placed.along(1 / a.clip.w, 1 / b.clip.w);
  bool usable = is_finite(planes.planes[0]) && is_finite(planes.planes[1]);
  for (int k = 0; k < vertices.layout.attribute_count; ++k) {
    const auto value = [&](const LinePoint& q) {
      return (q.weight[0] * vertices.attribute(v[0], k) + q.weight[1] * vertices.attribute(v[1], k)) / q.clip.w;
    };
    planes.planes[2 + k] = placed.along(value(a), value(b));
    usable = usable && is_finite(planes.planes[2 + k]);
  }
  return usable;
}

}  // namespace halfspace::raster
