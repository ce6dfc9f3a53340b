#include "tests/oracle/clip.h"

#include <algorithm>

namespace halfspace::oracle {
namespace {

// The house's band for snapped coordinates, pixels, and the least w that is taken to lie before the eye.
constexpr int kBandLow = -8192, kBandHigh = 24576;
constexpr double kLeastW = 1e-30;

// Sutherland and Hodgman's step: leaving starts the plane's own edge, coming back goes on along the edge it
// lies on.
template <class Distance>
Polygon cut_once(const Polygon& polygon, Distance distance, bool new_edge = true) {
  Polygon kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Corner &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const Wide d_from = distance(from), d_to = distance(to);
    if (d_from >= 0) kept.push_back(from);
    if ((d_from >= 0) == (d_to >= 0)) continue;
    const bool leaves = d_from >= 0;
    kept.push_back(leaves ? crossing(from, d_from, to, d_to) : crossing(to, d_to, from, d_from));
    kept.back().edge = leaves ? new_edge : from.edge;
  }
  return kept;
}

}  // namespace

// V = t P_in + (1 - t) P_out, t = d_out / (d_out - d_in) (spec 2.12, 2.14.8).
Corner crossing(const Corner& in, Wide d_in, const Corner& out, Wide d_out) {
  const Wide t_in = -d_out / (d_in - d_out), t_out = d_in / (d_in - d_out);
  const auto mix = [&](Wide a, Wide b) { return a * t_in + b * t_out; };
  Corner made;
  made.x = mix(in.x, out.x), made.y = mix(in.y, out.y), made.z = mix(in.z, out.z), made.w = mix(in.w, out.w);
  for (size_t i = 0; i < made.user.size(); ++i) made.user[i] = mix(in.user[i], out.user[i]);
  for (size_t i = 0; i < kValues; ++i) made.value[i] = mix(in.value[i], out.value[i]);
  return made;
}

Wide ClipVolume::distance(const Corner& c, int plane) const {
  // Window coordinates times w, from the band's edge: linear in the clip coordinates, whatever the sign of w.
  const auto window = [](Wide clip, Wide w, int origin, int size) {
    return (clip + w) * wide(size) / 2 + wide(origin) * w;
  };
  const raster::Viewport& v = state_.viewport;
  switch (plane) {
    case 0:
      return c.w + c.z;
    case 1:
      return c.w - c.z;
    case 2:
      return c.w + c.x;
    case 3:
      return c.w - c.x;
    case 4:
      return c.w + c.y;
    case 5:
      return c.w - c.y;
    case kPlaneW:
      return c.w - wide(kLeastW);
    case kFirstBand:
      return window(c.x, c.w, v.x, v.width) - wide(kBandLow) * c.w;
    case kFirstBand + 1:
      return wide(kBandHigh) * c.w - window(c.x, c.w, v.x, v.width);
    case kFirstBand + 2:
      return window(c.y, c.w, v.y, v.height) - wide(kBandLow) * c.w;
    case kFirstBand + 3:
      return wide(kBandHigh) * c.w - window(c.y, c.w, v.y, v.height);
    default:
      return c.user[static_cast<size_t>(plane - kFirstUser)];
  }
}

bool ClipVolume::applies(int plane) const {
  if (plane >= kFirstUser) return (state_.clip_planes.enabled >> (plane - kFirstUser) & 1) != 0;
  if (plane >= kFirstBand) return positions_ == Positions::snapped;
  return plane < 2 || plane == kPlaneW;
}

bool ClipVolume::rejects(const Corner* corners, size_t count) const {
  for (int plane = 0; plane < kPlanes; ++plane) {
    if (plane >= kFrustum && plane < kFirstUser) continue;
    if (plane >= kFirstUser && !applies(plane)) continue;
    if (std::all_of(corners, corners + count, [&](const Corner& c) { return distance(c, plane) < 0; }))
      return true;
  }
  return false;
}

Polygon ClipVolume::cut(const Polygon& polygon, bool* was_cut, bool by_user) const {
  Polygon left = polygon;
  *was_cut = false;
  // The user's planes first: where they leave little, that little is what the others see.
  const auto cut_by = [&](int plane) {
    const auto d = [&](const Corner& c) { return distance(c, plane); };
    if (!applies(plane) || std::all_of(left.begin(), left.end(), [&](const Corner& c) { return d(c) >= 0; }))
      return;
    *was_cut = true;
    left = cut_once(left, d);
  };
  for (int plane = kFirstUser; by_user && plane < kPlanes; ++plane) cut_by(plane);
  for (int plane = 0; plane < kFirstUser; ++plane) cut_by(plane);
  return left.size() < 3 ? Polygon() : left;
}

Polygon ClipVolume::cut_outline(const Polygon& polygon, bool at_view_volume) const {
  Polygon left = polygon;
  const auto cut_by = [&](int plane, bool new_edge) {
    left = cut_once(
        left, [&](const Corner& c) { return distance(c, plane); }, new_edge);
  };
  for (int plane = kFirstUser; plane < kPlanes; ++plane)
    if (applies(plane)) cut_by(plane, true);
  for (int plane = 0; at_view_volume && plane <= kPlaneW; ++plane) cut_by(plane, false);
  // The user's planes are done with: where an edge lies on one, rounding is not to decide about it again.
  for (Corner& c : left) c.user.fill(0);
  return left;
}

Polygon ClipVolume::cut_whole(const Polygon& polygon) const {
  const Polygon left = cut_outline(polygon, true);
  return left.size() < 3 ? Polygon() : left;
}

bool ClipVolume::cut(Corner (&ends)[2], bool sides) const {
  const auto cut_by = [&](int plane) {
    const Wide d[2] = {distance(ends[0], plane), distance(ends[1], plane)};
    if (d[0] < 0 && d[1] < 0) return false;
    if (d[0] < 0)
      ends[0] = crossing(ends[1], d[1], ends[0], d[0]);
    else if (d[1] < 0)
      ends[1] = crossing(ends[0], d[0], ends[1], d[1]);
    return true;
  };
  for (int plane = kFirstUser; plane < kPlanes; ++plane)
    if (applies(plane) && !cut_by(plane)) return false;
  for (int plane = 0; plane < kFirstUser; ++plane)
    if (applies(plane) && !cut_by(plane)) return false;
  for (int plane = 2; plane < kFrustum; ++plane)
    if (sides && !cut_by(plane)) return false;
  return true;
}

bool ClipVolume::holds(const Corner& corner) const {
  for (int plane = 0; plane < kPlanes; ++plane) {
    const bool asked = plane <= kPlaneW || (plane >= kFirstUser && applies(plane));
    if (asked && !(distance(corner, plane) >= 0)) return false;
  }
  return true;
}

}  // namespace halfspace::oracle
