#include "raster/primitive/clip.h"

#include <algorithm>
#include <cmath>

#include "raster/primitive/clip_planes.h"

namespace halfspace::raster {

void make_clip_planes(const WindowTransform& t, ClipPlane (&planes)[kClipPlanes]) {
  const double low = double(kGuardBandMin) * kSubpixelScale, high = double(kGuardBandMax) * kSubpixelScale;
  planes[0] = {kOutNear, 0, 0, 1, 1, 0};
  planes[1] = {kOutFar, 0, 0, -1, 1, 0};
  planes[2] = {kOutW, 0, 0, 0, 1, -kMinW};
  planes[3] = {kOutGuardLeft, t.scale_x, 0, 0, t.offset_x - low, 0};
  planes[4] = {kOutGuardRight, -t.scale_x, 0, 0, high - t.offset_x, 0};
  planes[5] = {kOutGuardBottom, 0, t.scale_y, 0, t.offset_y - low, 0};
  planes[6] = {kOutGuardTop, 0, -t.scale_y, 0, high - t.offset_y, 0};
}

namespace {

struct Corner {
  ClipVertex clip;
  int64_t original;             // the vertex it is, or -1 when it was made by a cut
  double user[kMaxClipPlanes];  // distances from the user planes, where there are any
};

Corner crossing_corner(const Corner& in, double d_in, const Corner& out, double d_out, bool has_user) {
  Corner made{crossing(in.clip, d_in, out.clip, d_out), -1, {}};
  if (!has_user) return made;
  for (int i = 0; i < kMaxClipPlanes; ++i) made.user[i] = crossing(in.user[i], d_in, out.user[i], d_out);
  return made;
}

struct CornerList {
  Corner v[kMaxPolygonVertices];
  int count = 0;
  void push(const Corner& c) {
    if (count < kMaxPolygonVertices) v[count++] = c;
  }
};

// Sutherland and Hodgman's step: what of the polygon lies inside one plane.
// distance(corner) >= 0 is inside.
template <class Distance>
void cut_polygon(Distance distance, bool has_user, const CornerList& in, CornerList& out) {
  out.count = 0;
  if (in.count == 0) return;
  const Corner* previous = &in.v[in.count - 1];
  double d_previous = distance(*previous);
  for (int i = 0; i < in.count; ++i) {
    const Corner* current = &in.v[i];
    const double d = distance(*current);
    if (d >= 0 && d_previous < 0) out.push(crossing_corner(*current, d, *previous, d_previous, has_user));
    if (d < 0 && d_previous >= 0) out.push(crossing_corner(*previous, d_previous, *current, d, has_user));
    if (d >= 0) out.push(*current);
    previous = current;
    d_previous = d;
  }
}

struct Point {
  int32_t x, y;
  bool operator==(const Point&) const = default;
};

// An original corner keeps the position the vertex stage gave it, since its neighbours use that.
Point snapped(const Corner& corner, const DrawRecord& draw, const WindowTransform& t) {
  if (corner.original >= 0) {
    const VertexHead& head = draw.vertices.head(uint32_t(corner.original));
    return {head.x, head.y};
  }
  const ClipVertex& c = corner.clip;
  return {snap_coordinate(c.x, c.w, t.scale_x, t.offset_x), snap_coordinate(c.y, c.w, t.scale_y, t.offset_y)};
}

int64_t cross(const Point& a, const Point& b, const Point& c) {
  return int64_t{b.x - a.x} * (c.y - a.y) - int64_t{c.x - a.x} * (b.y - a.y);
}

int64_t polygon_area(const Point* p, int count) {
  int64_t area = 0;
  for (int i = 1; i + 1 < count; ++i) area += cross(p[0], p[i], p[i + 1]);
  return area;
}

// Snapping can make a cut polygon slightly concave; a fan from the wrong corner would then cover pixels
// twice.
bool is_good_apex(const Point* p, int count, int apex, int64_t area) {
  for (int i = 1; i + 1 < count; ++i) {
    const int64_t part = cross(p[apex], p[(apex + i) % count], p[(apex + i + 1) % count]);
    if (area > 0 ? part < 0 : part > 0) return false;
  }
  return true;
}

bool is_lower(int32_t x, int32_t y, int32_t than_x, int32_t than_y) {
  return y != than_y ? y < than_y : x < than_x;
}

int lowest(const Point* p, int count) {
  int best = 0;
  for (int i = 1; i < count; ++i) {
    if (is_lower(p[i].x, p[i].y, p[best].x, p[best].y)) best = i;
  }
  return best;
}

// The lowest corner, or else the next one round that serves; -1: none does. The first choice does not depend
// on the order the corners came in; the others only matter where snapping has bent the polygon.
int choose_apex(const Point* p, int count, int64_t area) {
  const int start = lowest(p, count);
  for (int i = 0; i < count; ++i) {
    const int apex = (start + i) % count;
    if (is_good_apex(p, count, apex, area)) return apex;
  }
  return -1;
}

// The corners of a polygon that are still to be cut off, as indices.
struct Rest {
  const Point* p;
  int64_t sign;  // of the whole's area
  uint8_t at[kMaxPolygonVertices];
  int count;

  const Point& corner(int i) const { return p[at[(i + count) % count]]; }
  // Twice the area at corner i; positive if it turns as the whole does.
  int64_t turn(int i) const { return sign * cross(corner(i - 1), corner(i), corner(i + 1)); }
  bool is_free(int i) const {
    const Point &a = corner(i - 1), &b = corner(i), &c = corner(i + 1);
    for (int k = 0; k < count; ++k) {
      const Point& q = corner(k);
      if (q == a || q == b || q == c) continue;
      if (sign * cross(a, b, q) >= 0 && sign * cross(b, c, q) >= 0 && sign * cross(c, a, q) >= 0)
        return false;
    }
    return true;
  }
  // A corner to cut off: flat, or an ear, with no other corner in its triangle. -1: edges cross.
  int ear() const {
    for (int i = 0; i < count; ++i)
      if (turn(i) == 0 || (turn(i) > 0 && is_free(i))) return i;
    return -1;
  }
  int flattest() const {
    int best = 0;
    for (int i = 1; i < count; ++i)
      if (std::abs(turn(i)) < std::abs(turn(best))) best = i;
    return best;
  }
};

void add_triangle(Clipper::Polygon& out, int a, int b, int c) {
  uint8_t(&t)[3] = out.triangle[out.triangle_count++];
  t[0] = uint8_t(a), t[1] = uint8_t(b), t[2] = uint8_t(c);
}

void fan(int count, int apex, Clipper::Polygon& out) {
  for (int i = 1; i + 1 < count; ++i) add_triangle(out, apex, (apex + i) % count, (apex + i + 1) % count);
}

// Whether one of the edges of triangle `s` has all of triangle `t` outside.
bool parts(const Point* p, int64_t sign, const uint8_t (&s)[3], const uint8_t (&t)[3]) {
  for (int i = 0; i < 3; ++i) {
    const Point &a = p[s[i]], &b = p[s[(i + 1) % 3]];
    if (std::all_of(t, t + 3, [&](uint8_t k) { return sign * cross(a, b, p[k]) <= 0; })) return true;
  }
  return false;
}

bool overlaps_an_earlier(const Point* p, int64_t sign, const Clipper::Polygon& out) {
  const auto& last = out.triangle[out.triangle_count - 1];
  for (int i = 0; i + 1 < out.triangle_count; ++i)
    if (!parts(p, sign, out.triangle[i], last) && !parts(p, sign, last, out.triangle[i])) return true;
  return false;
}

// Where no corner serves: ear by ear. Of edges that cross, by a sub-pixel, what turns back is left out, and
// what would be drawn twice.
void cut_ears(const Point* p, int count, int64_t area, Clipper::Polygon& out) {
  Rest rest{p, area > 0 ? 1 : -1, {}, count};
  for (int i = 0; i < count; ++i) rest.at[i] = uint8_t(i);
  while (rest.count >= 3) {
    const int ear = rest.ear(), corner = ear >= 0 ? ear : rest.flattest();
    if (ear >= 0 && rest.turn(ear) > 0) {
      add_triangle(out, rest.at[(ear + rest.count - 1) % rest.count], rest.at[ear],
                   rest.at[(ear + 1) % rest.count]);
      if (overlaps_an_earlier(p, rest.sign, out)) --out.triangle_count;
    }
    std::copy(rest.at + corner + 1, rest.at + rest.count, rest.at + corner);
    --rest.count;
  }
}

int drop_repeated(Point* p, int count) {
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    if (kept == 0 || !(p[i] == p[kept - 1])) p[kept++] = p[i];
  }
  while (kept > 1 && p[kept - 1] == p[0]) --kept;
  return kept;
}

}  // namespace

Clipper::Clipper(const DrawRecord& draw)
    : draw_(draw), window_(make_window_transform(draw.state->viewport)) {}

void Clipper::clip_triangle(const uint32_t v[3], unsigned outcodes, Polygon& out) const {
  out.count = 0;
  out.area = 0;
  out.triangle_count = 0;
  ClipPlane planes[kClipPlanes];
  make_clip_planes(window_, planes);
  CornerList lists[2];
  const bool has_user = outcodes >= user_outcode(0);
  for (int i = 0; i < 3; ++i) {
    Corner corner{draw_.vertices.clip[v[i]], int64_t{v[i]}, {}};
    if (has_user)
      std::copy_n(draw_.clip_distances + size_t{v[i]} * kMaxClipPlanes, kMaxClipPlanes, corner.user);
    lists[0].push(corner);
  }
  int current = 0;
  const auto cut = [&](auto distance) {
    cut_polygon(distance, has_user, lists[current], lists[1 - current]);
    current = 1 - current;
  };
  for (int i = 0; has_user && i < kMaxClipPlanes; ++i) {
    if (outcodes & user_outcode(i)) cut([i](const Corner& c) { return c.user[i]; });
  }
  for (const ClipPlane& plane : planes) {
    if (outcodes & plane.outcode) cut([&plane](const Corner& c) { return distance(plane, c.clip); });
  }
  const CornerList& left = lists[current];
  Point p[kMaxPolygonVertices];
  for (int i = 0; i < left.count; ++i) {
    if (!(left.v[i].clip.w > 0)) return;
    p[i] = snapped(left.v[i], draw_, window_);
  }
  const int count = drop_repeated(p, left.count);
  if (count < 3) return;
  out.area = polygon_area(p, count);
  if (out.area == 0) return;
  out.count = count;
  for (int i = 0; i < count; ++i) out.x[i] = p[i].x, out.y[i] = p[i].y;
  const int apex = choose_apex(p, count, out.area);
  if (apex >= 0)
    fan(count, apex, out);
  else
    cut_ears(p, count, out.area, out);
}

namespace {

// A corner of the whole triangle: (x / w, y / w) is its place in pixels relative to the anchor.
struct HomogeneousCorner {
  double x, y, w;
  uint32_t vertex;
};

HomogeneousCorner corner_at(const ClipVertex& c, uint32_t vertex, const WindowTransform& t, double anchor_x,
                            double anchor_y) {
  constexpr double kPixel = 1.0 / kSubpixelScale;
  return {(c.x * t.scale_x + c.w * (t.offset_x - anchor_x)) * kPixel,
          (c.y * t.scale_y + c.w * (t.offset_y - anchor_y)) * kPixel, c.w, vertex};
}

bool precedes(const ClipVertex& a, const ClipVertex& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  if (a.w != b.w) return a.w < b.w;
  return a.z < b.z;
}

// By position, so that the order the vertices came in changes no bit.
void sort_corners(const ClipVertex* clip, uint32_t v[3]) {
  if (precedes(clip[v[1]], clip[v[0]])) std::swap(v[0], v[1]);
  if (precedes(clip[v[2]], clip[v[1]])) std::swap(v[1], v[2]);
  if (precedes(clip[v[1]], clip[v[0]])) std::swap(v[0], v[1]);
}

// The inverse of the matrix with the corners as columns: row i, times (x, y, 1), is corner i's weight over w.
struct Adjugate {
  Plane row[3];  // f0: constant term
  bool usable;
};

Adjugate invert(const HomogeneousCorner (&c)[3]) {
  Adjugate result{};
  double cofactor_x[3], cofactor_y[3], cofactor_1[3];
  for (int i = 0; i < 3; ++i) {
    const HomogeneousCorner &j = c[(i + 1) % 3], &k = c[(i + 2) % 3];
    cofactor_x[i] = j.y * k.w - k.y * j.w;
    cofactor_y[i] = k.x * j.w - j.x * k.w;
    cofactor_1[i] = j.x * k.y - k.x * j.y;
  }
  const double det = (c[0].w * cofactor_1[0] + c[1].w * cofactor_1[1]) + c[2].w * cofactor_1[2];
  const double scale = 1.0 / det;
  result.usable = std::isfinite(det) && std::isfinite(scale);
  for (int i = 0; i < 3; ++i) {
    result.row[i] = {cofactor_1[i] * scale, cofactor_x[i] * scale, cofactor_y[i] * scale};
  }
  return result;
}

Plane combine(const Adjugate& a, double f0, double f1, double f2) {
  const Plane *r0 = &a.row[0], *r1 = &a.row[1], *r2 = &a.row[2];
  return {(f0 * r0->f0 + f1 * r1->f0) + f2 * r2->f0, (f0 * r0->dfdx + f1 * r1->dfdx) + f2 * r2->dfdx,
          (f0 * r0->dfdy + f1 * r1->dfdy) + f2 * r2->dfdy};
}

bool is_finite(const Plane& p) {
  return std::isfinite(p.f0) && std::isfinite(p.dfdx) && std::isfinite(p.dfdy);
}

}  // namespace

bool Clipper::triangle_planes(const uint32_t v[3], const Polygon& polygon, PlaneSource& out) const {
  out.x0 = polygon.x[0], out.y0 = polygon.y[0];
  for (int i = 1; i < polygon.count; ++i) {
    if (is_lower(polygon.x[i], polygon.y[i], out.x0, out.y0)) out.x0 = polygon.x[i], out.y0 = polygon.y[i];
  }
  const ClipVertex* clip = draw_.vertices.clip.data();
  uint32_t sorted[3] = {v[0], v[1], v[2]};
  sort_corners(clip, sorted);
  HomogeneousCorner corners[3];
  for (int i = 0; i < 3; ++i) corners[i] = corner_at(clip[sorted[i]], sorted[i], window_, out.x0, out.y0);
  const Adjugate inverse = invert(corners);
  if (!inverse.usable) return false;
  // z / w is linear in the window; depth is that, scaled and moved by the depth range.
  Plane depth = combine(inverse, clip[sorted[0]].z, clip[sorted[1]].z, clip[sorted[2]].z);
  depth = {depth.f0 * window_.depth_scale + window_.depth_offset, depth.dfdx * window_.depth_scale,
           depth.dfdy * window_.depth_scale};
  out.planes[0] = depth;
  out.planes[1] = combine(inverse, 1, 1, 1);
  bool usable = is_finite(depth) && is_finite(out.planes[1]);
  const bool back = (polygon.area > 0) != draw_.state->raster.front_is_ccw;
  for (int k = 0; k < draw_.vertices.layout.attribute_count; ++k) {
    const int at = draw_.vertices.layout.place(k, back);
    const ShadedVertices& vertices = draw_.vertices;
    out.planes[2 + k] = combine(inverse, vertices.attribute(sorted[0], at), vertices.attribute(sorted[1], at),
                                vertices.attribute(sorted[2], at));
    usable = usable && is_finite(out.planes[2 + k]);
  }
  return usable;
}

}  // namespace halfspace::raster
