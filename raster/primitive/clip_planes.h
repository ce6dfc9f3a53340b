// The planes primitives are cut against, and the one formula for a new vertex.
#pragma once

#include "raster/vertex/window_transform.h"

namespace halfspace::raster {

struct ClipPlane {
  unsigned outcode;
  double x, y, z, w, constant;  // inside: x*X + y*Y + z*Z + w*W + constant >= 0
};

// In the order they are applied. Near and far first: what they leave normally has w > 0 already, and the
// other planes then meet no huge numbers.
inline constexpr int kClipPlanes = 7;
inline constexpr int kDepthClipPlanes = 3;  // of them: near, far, w; the others are the guard band's
void make_clip_planes(const WindowTransform& window, ClipPlane (&planes)[kClipPlanes]);

inline double distance(const ClipPlane& p, const ClipVertex& v) {
  return (((p.x * v.x + p.y * v.y) + p.z * v.z) + p.w * v.w) + p.constant;
}

// The point of the edge on the plane, as a weighted sum: weights are positive, so nothing cancels however
// long the edge is, and the same bits result from whichever end the edge is walked.
//   d_in >= 0 > d_out: the distances of its ends.
inline double crossing(double in, double d_in, double out, double d_out) {
  return (in * -d_out + out * d_in) / (d_in - d_out);
}
inline ClipVertex crossing(const ClipVertex& in, double d_in, const ClipVertex& out, double d_out) {
  return {crossing(in.x, d_in, out.x, d_out), crossing(in.y, d_in, out.y, d_out),
          crossing(in.z, d_in, out.z, d_out), crossing(in.w, d_in, out.w, d_out)};
}

}  // namespace halfspace::raster
