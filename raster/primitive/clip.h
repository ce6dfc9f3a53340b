// Clipping in homogeneous coordinates: near and far, w > 0, and the guard band (spec 2.11, NUMERICS
// "Clipping").
#pragma once

#include "raster/primitive/segment.h"
#include "raster/vertex/window_transform.h"

namespace halfspace::raster {

// A triangle gets at most one corner more from each of the seven planes and the user's.
inline constexpr int kMaxPolygonVertices = 10 + kMaxClipPlanes;

// Bit of user plane i in the codes the clipper takes, beside the vertex stage's outcodes.
constexpr unsigned user_outcode(int i) { return 0x10000u << i; }

// Twice the signed area, 16.8 squared.
inline int64_t triangle_area(const int32_t (&x)[3], const int32_t (&y)[3]) {
  return int64_t{x[1] - x[0]} * (y[2] - y[0]) - int64_t{x[2] - x[0]} * (y[1] - y[0]);
}

// Clips one draw's primitives. Holds what does not change over a draw.
class Clipper {
 public:
  explicit Clipper(const DrawRecord& draw);

  struct Polygon {
    int count = 0;                   // 0: nothing is left
    int64_t area = 0;                // twice the signed area, 16.8 squared; > 0 is counter-clockwise
    int32_t x[kMaxPolygonVertices];  // 16.8
    int32_t y[kMaxPolygonVertices];
    int triangle_count = 0;
    uint8_t triangle[kMaxPolygonVertices - 2][3];  // corners; none turns the other way than the whole

    // Its lowest corner, then leftmost.
    int lowest() const;
    CutTriangle triangle_at(int i, uint32_t source) const {
      const uint8_t(&t)[3] = triangle[i];
      return {{x[t[0]], x[t[1]], x[t[2]]}, {y[t[0]], y[t[1]], y[t[2]]}, source};
    }
  };

  // Cuts the triangle of vertices v[0..2]; `outcodes` is the union of theirs, user planes included.
  void clip_triangle(const uint32_t v[3], unsigned outcodes, Polygon& out) const;
  // Its planes, relative to the polygon's lowest corner (then leftmost). False: the triangle has no usable
  // plane.
  bool triangle_planes(const uint32_t v[3], const Polygon& polygon, PlaneSource& out) const;

  // Cuts the line v[0], v[1] to out.x[0..1]; false: nothing is left.
  bool clip_line(const uint32_t v[2], unsigned outcodes, CutTriangle& out, PlaneSource& planes) const;

 private:
  const DrawRecord& draw_;
  WindowTransform window_;
};

}  // namespace halfspace::raster
