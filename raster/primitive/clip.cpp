#include "raster/primitive/clip.h"

#include <algorithm>
#include <cmath>

#include "raster/primitive/clip_planes.h"
#include "raster/primitive/triangle_cut.h"

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

int Clipper::Polygon::lowest() const {
  int best = 0;
  for (int i = 1; i < count; ++i) {
    if (is_lower(x[i], y[i], x[best], y[best])) best = i;
  }
  return best;
}

bool Clipper::triangle_planes(const uint32_t v[3], const Polygon& polygon, PlaneSource& out) const {
  PlaneJob job;
  const int anchor = polygon.lowest();
  job.count = 1;
  std::copy_n(v, 3, job.v[0]);
  const ClipVertex clip[3] = {draw_.vertices.clip[v[0]], draw_.vertices.clip[v[1]],
                              draw_.vertices.clip[v[2]]};
  job.clip[0] = clip;
  job.back[0] = (polygon.area > 0) != draw_.state->raster.front_is_ccw;
  job.anchor_x[0] = polygon.x[anchor], job.anchor_y[0] = polygon.y[anchor];
  triangle_cut_functions().make_planes(draw_.vertices, window_, job);
  out = job.planes[0];
  return job.usable != 0;
}

}  // namespace halfspace::raster
