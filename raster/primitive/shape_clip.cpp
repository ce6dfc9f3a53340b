#include "raster/primitive/shape_clip.h"

#include <algorithm>
#include <cmath>

#include "raster/primitive/clip.h"
#include "raster/primitive/line_place.h"

namespace halfspace::raster {
namespace {

ShapeVertex made_vertex(const ShapeVertex& in, double d_in, const ShapeVertex& out, double d_out) {
  ShapeVertex v;
  v.clip = crossing(in.clip, d_in, out.clip, d_out);
  for (int i = 0; i < kMaxClipPlanes; ++i) v.user[i] = crossing(in.user[i], d_in, out.user[i], d_out);
  for (int i = 0; i < kMaxPlanes - 2; ++i) v.value[i] = crossing(in.value[i], d_in, out.value[i], d_out);
  v.original = -1;
  v.edge = false;
  return v;
}

// Sutherland and Hodgman's step. `new_edge`: whether the edge along the plane is drawn. Edges keep their
// order: the one that comes last is seen where two meet.
template <class Distance>
void cut_polygon(Distance distance, bool new_edge, const std::vector<ShapeVertex>& in,
                 std::vector<ShapeVertex>& out) {
  out.clear();
  if (in.empty()) return;
  const double d_first = distance(in.front());
  double d = d_first;
  for (size_t i = 0; i < in.size(); ++i) {
    const bool last = i + 1 == in.size();
    const ShapeVertex &from = in[i], &to = last ? in.front() : in[i + 1];
    const double d_to = last ? d_first : distance(to);
    if (d >= 0) out.push_back(from);
    if (d >= 0 && d_to < 0) {
      out.push_back(made_vertex(from, d, to, d_to));
      out.back().edge = new_edge;
    }
    if (d < 0 && d_to >= 0) {
      out.push_back(made_vertex(to, d_to, from, d));
      out.back().edge = from.edge;
    }
    d = d_to;
  }
}

// The sides of the view volume. Polygons that are filled are cut there by the scissor.
constexpr ClipPlane kSides[] = {{kOutLeft, 1, 0, 0, 1, 0},
                                {kOutRight, -1, 0, 0, 1, 0},
                                {kOutBottom, 0, 1, 0, 1, 0},
                                {kOutTop, 0, -1, 0, 1, 0}};

// d: distances of the ends. False: nothing is left.
bool cut_line(const double (&d)[2], ShapeVertex (&ends)[2]) {
  if (!(d[0] >= 0) && !(d[1] >= 0)) return false;
  if (d[0] < 0)
    ends[0] = made_vertex(ends[1], d[1], ends[0], d[0]);
  else if (d[1] < 0)
    ends[1] = made_vertex(ends[0], d[0], ends[1], d[1]);
  return true;
}

bool is_finite(const Plane& p) {
  return std::isfinite(p.f0) && std::isfinite(p.dfdx) && std::isfinite(p.dfdy);
}

double window_depth(const WindowTransform& window, const ClipVertex& v) {
  const double z = v.z / v.w * window.depth_scale + window.depth_offset;
  return std::clamp(z, window.depth_low, window.depth_high);
}

}  // namespace

ShapeVertex shape_vertex(const DrawRecord& draw, uint32_t v, bool back) {
  ShapeVertex out{};
  out.clip = draw.vertices.clip[v];
  out.original = v;
  out.edge = true;
  if (draw.clip_distances != nullptr) {
    std::copy_n(draw.clip_distances + size_t{v} * kMaxClipPlanes, kMaxClipPlanes, out.user);
  }
  const VertexLayout& layout = draw.vertices.layout;
  for (int i = 0; i < layout.attribute_count; ++i) out.value[i] = draw.vertices.attribute(v, layout.place(i, back));
  return out;
}

void cut_by_user_planes(unsigned codes, std::vector<ShapeVertex>& polygon,
                        std::vector<ShapeVertex>& scratch) {
  for (int i = 0; i < kMaxClipPlanes; ++i) {
    if (!(codes & user_outcode(i))) continue;
    cut_polygon([i](const ShapeVertex& v) { return v.user[i]; }, true, polygon, scratch);
    polygon.swap(scratch);
  }
}

void cut_by_view_volume(const WindowTransform& window, unsigned codes, std::vector<ShapeVertex>& polygon,
                        std::vector<ShapeVertex>& scratch) {
  const auto cut = [&](const ClipPlane& plane) {
    if (!(codes & plane.outcode)) return;
    cut_polygon([&](const ShapeVertex& v) { return distance(plane, v.clip); }, false, polygon, scratch);
    polygon.swap(scratch);
  };
  ClipPlane planes[kClipPlanes];
  make_clip_planes(window, planes);
  for (int i = 0; i < kDepthClipPlanes; ++i) cut(planes[i]);
  for (const ClipPlane& plane : kSides) cut(plane);
}

bool cut_shape_line(const WindowTransform& window, unsigned codes, bool sides, ShapeVertex (&ends)[2]) {
  for (int i = 0; i < kMaxClipPlanes; ++i) {
    if ((codes & user_outcode(i)) && !cut_line({ends[0].user[i], ends[1].user[i]}, ends)) return false;
  }
  const auto cut = [&](const ClipPlane& plane) {
    if (!(codes & plane.outcode)) return true;
    return cut_line({distance(plane, ends[0].clip), distance(plane, ends[1].clip)}, ends);
  };
  ClipPlane planes[kClipPlanes];
  make_clip_planes(window, planes);
  for (const ClipPlane& plane : planes) {
    if (!cut(plane)) return false;
  }
  for (const ClipPlane& plane : kSides) {
    if (sides && !cut(plane)) return false;
  }
  return ends[0].clip.w > 0 && ends[1].clip.w > 0;
}

void place_vertex(const DrawRecord& draw, const WindowTransform& window, const ShapeVertex& vertex,
                  int32_t& x, int32_t& y) {
  if (vertex.original >= 0) {
    x = draw.vertices.head(uint32_t(vertex.original)).x;
    y = draw.vertices.head(uint32_t(vertex.original)).y;
    return;
  }
  x = snap_coordinate(vertex.clip.x, vertex.clip.w, window.scale_x, window.offset_x);
  y = snap_coordinate(vertex.clip.y, vertex.clip.w, window.scale_y, window.offset_y);
}

bool line_planes(const DrawRecord& draw, const WindowTransform& window, const ShapeVertex (&ends)[2],
                 bool along_major, double offset, const CutTriangle& line, PlaneSource& out) {
  // The anchor is the lower end, so direction changes no bit.
  const bool swap = line.y[0] != line.y[1] ? line.y[1] < line.y[0] : line.x[1] < line.x[0];
  const ShapeVertex &a = ends[swap], &b = ends[!swap];
  out.x0 = line.x[swap], out.y0 = line.y[swap];
  const LinePlace place(window, {a.clip, b.clip, out.x0, out.y0, line.x[!swap], line.y[!swap]}, along_major);
  out.planes[0] = place.along(window_depth(window, a.clip) + offset, window_depth(window, b.clip) + offset);
  out.planes[1] = place.along(1 / a.clip.w, 1 / b.clip.w);
  bool usable = is_finite(out.planes[0]) && is_finite(out.planes[1]);
  for (int k = 0; k < draw.vertices.layout.attribute_count; ++k) {
    out.planes[2 + k] = place.along(a.value[k] / a.clip.w, b.value[k] / b.clip.w);
    usable = usable && is_finite(out.planes[2 + k]);
  }
  return usable;
}

bool point_planes(const DrawRecord& draw, const WindowTransform& window, const ShapeVertex& vertex,
                  double offset, const CutTriangle& point, PlaneSource& out) {
  out.x0 = point.x[0], out.y0 = point.y[0];
  out.planes[0] = {window_depth(window, vertex.clip) + offset, 0, 0};
  out.planes[1] = {1 / vertex.clip.w, 0, 0};
  bool usable = is_finite(out.planes[0]) && is_finite(out.planes[1]);
  for (int k = 0; k < draw.vertices.layout.attribute_count; ++k) {
    out.planes[2 + k] = {vertex.value[k] / vertex.clip.w, 0, 0};
    usable = usable && is_finite(out.planes[2 + k]);
  }
  return usable;
}

}  // namespace halfspace::raster
