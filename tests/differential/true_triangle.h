// A triangle as the numeric contract says it is drawn: cut in homogeneous space, snapped to 1/256 px, covered
// exactly; what it carries is interpolated in long double.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ref_app/gapi.h"
#include "tests/oracle/coverage.h"

namespace halfspace::differential {

using Real = long double;

struct Clip {
  Real x, y, z, w;
};
struct Corner {
  Clip clip;
  std::array<Real, 4> color;  // clamped to [0, 1]
  std::array<Real, 2> tex_coord;
};

// projection * model_view * position, from the float matrices without rounding worth the name.
Clip to_clip(const ref_app::PipelineState& state, const glm::vec4& position);

// value(x, y) = base + dx * x + dy * y, in pixels from the window's lower left corner.
struct RealPlane {
  Real base = 0, dx = 0, dy = 0;
  Real at(Real x, Real y) const { return base + dx * x + dy * y; }
};

enum class Positions : uint8_t {
  snapped,  // what is carried belongs to the corners where they were snapped to: the numeric contract
  ideal,    // ... to the corners where they would be without snapping
};

// What our renderer promises; the pictures of others are held to either.
inline constexpr Positions kContract = Positions::ideal;

class TrueTriangle {
 public:
  TrueTriangle(const std::array<Corner, 3>& corners, int width, int height, Positions positions);

  // Calls visit(x, y) for the pixels the triangle owns in rows [y0, y1) of the window.
  template <class Visit>
  void for_each_pixel(int y0, int y1, Visit visit) const;

  // Window depth as the depth buffer holds it: 0 .. 2^24 - 1.
  uint32_t depth(int x, int y) const;
  // Perspective-correct: colour, then texture coordinates.
  std::array<Real, 6> attributes(int x, int y) const;
  // From the pixel's centre, in pixels, to the nearest of the edges.
  double distance_to_edge(int x, int y) const;

 private:
  struct Edge {
    int64_t at_origin, dx, dy;  // per pixel; the pixel at (0, 0) is owned when at_origin >= 0
  };
  void find_outline(const std::array<Corner, 3>& corners);
  void find_planes(const std::array<Corner, 3>& corners, Positions positions);

  int width_, height_;
  bool cut_ = false;
  std::vector<oracle::SnappedPoint> outline_;  // counter-clockwise; empty: nothing to see
  std::vector<Edge> edges_;
  int min_x_ = 0, max_x_ = -1, min_y_ = 0, max_y_ = -1;  // pixels the outline's box can own
  RealPlane depth_, inv_w_;
  std::array<RealPlane, 6> over_w_;
};

template <class Visit>
void TrueTriangle::for_each_pixel(int y0, int y1, Visit visit) const {
  const int last = max_y_ < y1 - 1 ? max_y_ : y1 - 1;
  for (int y = min_y_ > y0 ? min_y_ : y0; y <= last; ++y) {
    for (int x = min_x_; x <= max_x_; ++x) {
      bool inside = true;
      for (const Edge& edge : edges_) inside = inside && edge.at_origin + edge.dx * x + edge.dy * y >= 0;
      if (inside) visit(x, y);
    }
  }
}

}  // namespace halfspace::differential
