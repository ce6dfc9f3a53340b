#include "tests/differential/true_triangle.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace halfspace::differential {
namespace {

using oracle::SnappedPoint;

constexpr int64_t kSubpixels = 256;
constexpr uint32_t kDepthMax = (1u << 24) - 1;

Real real(float v) { return static_cast<Real>(v); }

// Near, then far; inside where >= 0. x and y need no cutting: coordinates here are as wide as they come.
Real distance(const Clip& c, int plane) { return plane == 0 ? c.z + c.w : c.w - c.z; }

Clip crossing(const Clip& in, const Clip& out, int plane) {
  const Real d_in = distance(in, plane), d_out = distance(out, plane), span = d_in - d_out;
  const auto mix = [&](Real a, Real b) { return (b * d_in - a * d_out) / span; };
  return {mix(in.x, out.x), mix(in.y, out.y), mix(in.z, out.z), mix(in.w, out.w)};
}

std::vector<Clip> cut(const std::vector<Clip>& polygon, int plane) {
  std::vector<Clip> kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Clip &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const bool from_in = distance(from, plane) >= 0, to_in = distance(to, plane) >= 0;
    if (from_in) kept.push_back(from);
    if (from_in != to_in) kept.push_back(from_in ? crossing(from, to, plane) : crossing(to, from, plane));
  }
  return kept;
}

// The window's half is an integer number of 1/256 px, so the snapping may be done about its middle.
SnappedPoint snapped(const Clip& c, int width, int height) {
  const auto place = [](Real ndc, int size) { return oracle::snap((ndc + 1) * size / 2); };
  const SnappedPoint p{place(c.x / c.w, width), place(c.y / c.w, height)};
  // Products of two differences stay within 64 bits.
  if (std::max(std::llabs(p.x), std::llabs(p.y)) > int64_t{1} << 29) {
    throw std::range_error("a corner lies too far outside the window");
  }
  return p;
}

int64_t twice_area(const std::vector<SnappedPoint>& p) {
  int64_t area = 0;
  for (size_t i = 1; i + 1 < p.size(); ++i) {
    area += (p[i].x - p[0].x) * (p[i + 1].y - p[0].y) - (p[i].y - p[0].y) * (p[i + 1].x - p[0].x);
  }
  return area;
}

// First pixel whose centre is at or beyond `v`, and last one at or before it.
int first_center(int64_t v) { return static_cast<int>((v + kSubpixels / 2 - 1) >> 8); }
int last_center(int64_t v) { return static_cast<int>((v - kSubpixels / 2) >> 8); }

// The functions that are 1 at one corner and 0 at the two others, each times w, divided by w: affine in the
// window whatever the signs of w (the adjugate of the matrix of corners in (x, y, 1) * w).
std::array<RealPlane, 3> weights(const std::array<Real, 3>& x, const std::array<Real, 3>& y,
                                 const std::array<Real, 3>& w) {
  std::array<RealPlane, 3> plane;
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3, k = (i + 2) % 3;
    plane[i] = {x[j] * y[k] - x[k] * y[j], y[j] * w[k] - y[k] * w[j], x[k] * w[j] - x[j] * w[k]};
  }
  const Real determinant = x[0] * plane[0].dx + y[0] * plane[0].dy + w[0] * plane[0].base;
  for (RealPlane& p : plane) p = {p.base / determinant, p.dx / determinant, p.dy / determinant};
  return plane;
}

RealPlane combine(const std::array<RealPlane, 3>& weight, Real a, Real b, Real c) {
  return {weight[0].base * a + weight[1].base * b + weight[2].base * c,
          weight[0].dx * a + weight[1].dx * b + weight[2].dx * c,
          weight[0].dy * a + weight[1].dy * b + weight[2].dy * c};
}

Real attribute(const Corner& corner, size_t i) { return i < 4 ? corner.color[i] : corner.tex_coord[i - 4]; }

}  // namespace

Clip to_clip(const ref_app::PipelineState& state, const glm::vec4& position) {
  Real product[4][4] = {}, clip[4] = {};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      for (int k = 0; k < 4; ++k) {
        product[row][column] += real(state.projection[k][row]) * real(state.model_view[column][k]);
      }
      clip[row] += product[row][column] * real(position[column]);
    }
  }
  return {clip[0], clip[1], clip[2], clip[3]};
}

TrueTriangle::TrueTriangle(const std::array<Corner, 3>& corners, int width, int height, Positions positions)
    : width_(width), height_(height) {
  find_outline(corners);
  if (!outline_.empty()) find_planes(corners, positions);
}

void TrueTriangle::find_outline(const std::array<Corner, 3>& corners) {
  std::vector<Clip> polygon;
  for (const Corner& corner : corners) polygon.push_back(corner.clip);
  for (int plane = 0; plane < 2; ++plane) {
    const auto outside = [plane](const Clip& c) { return distance(c, plane) < 0; };
    if (std::none_of(polygon.begin(), polygon.end(), outside)) continue;
    cut_ = true;
    polygon = cut(polygon, plane);
  }
  for (const Clip& c : polygon) {
    if (!(c.w > 0)) return void(outline_.clear());
    outline_.push_back(snapped(c, width_, height_));
  }
  const int64_t area = twice_area(outline_);
  if (area == 0) return void(outline_.clear());
  if (area < 0) std::reverse(outline_.begin(), outline_.end());

  const auto [left, right] = std::minmax_element(outline_.begin(), outline_.end(),
                                                 [](const auto& a, const auto& b) { return a.x < b.x; });
  const auto [low, high] = std::minmax_element(outline_.begin(), outline_.end(),
                                               [](const auto& a, const auto& b) { return a.y < b.y; });
  min_x_ = std::max(first_center(left->x), 0), max_x_ = std::min(last_center(right->x), width_ - 1);
  min_y_ = std::max(first_center(low->y), 0), max_y_ = std::min(last_center(high->y), height_ - 1);
  for (size_t i = 0; i < outline_.size(); ++i) {
    const SnappedPoint &a = outline_[i], &b = outline_[(i + 1) % outline_.size()];
    const int64_t dx = b.x - a.x, dy = b.y - a.y;
    // Left edges go down and the top edge goes left; on the others' points nothing is owned.
    const bool owns = dy < 0 || (dy == 0 && dx < 0);
    const int64_t at_center = dx * (kSubpixels / 2 - a.y) - dy * (kSubpixels / 2 - a.x);
    if (dx != 0 || dy != 0) edges_.push_back({at_center - (owns ? 0 : 1), -dy * kSubpixels, dx * kSubpixels});
  }
}

void TrueTriangle::find_planes(const std::array<Corner, 3>& corners, Positions positions) {
  std::array<Real, 3> x, y, w, z;
  for (size_t i = 0; i < 3; ++i) {
    const Clip& c = corners[i].clip;
    w[i] = c.w, z[i] = c.z;
    if (cut_ || positions == Positions::ideal) {
      x[i] = (c.x + c.w) * width_ / 2, y[i] = (c.y + c.w) * height_ / 2;
    } else {
      const SnappedPoint p = snapped(c, width_, height_);
      x[i] = w[i] * static_cast<Real>(p.x) / kSubpixels, y[i] = w[i] * static_cast<Real>(p.y) / kSubpixels;
    }
  }
  const std::array<RealPlane, 3> weight = weights(x, y, w);
  inv_w_ = combine(weight, 1, 1, 1);
  depth_ = combine(weight, z[0], z[1], z[2]);
  for (size_t i = 0; i < 6; ++i) {
    over_w_[i] =
        combine(weight, attribute(corners[0], i), attribute(corners[1], i), attribute(corners[2], i));
  }
}

uint32_t TrueTriangle::depth(int x, int y) const {
  const Real z = depth_.at(x + 0.5L, y + 0.5L) / 2 + 0.5L;
  return static_cast<uint32_t>(std::floor(std::clamp(z, 0.0L, 1.0L) * kDepthMax + 0.5L));
}

std::array<Real, 6> TrueTriangle::attributes(int x, int y) const {
  const Real w = 1 / inv_w_.at(x + 0.5L, y + 0.5L);
  std::array<Real, 6> value;
  for (size_t i = 0; i < 6; ++i) value[i] = over_w_[i].at(x + 0.5L, y + 0.5L) * w;
  return value;
}

double TrueTriangle::distance_to_edge(int x, int y) const {
  double nearest = 1e300;
  for (size_t i = 0; i < outline_.size(); ++i) {
    const SnappedPoint &a = outline_[i], &b = outline_[(i + 1) % outline_.size()];
    const int64_t dx = b.x - a.x, dy = b.y - a.y;
    if (dx == 0 && dy == 0) continue;
    const int64_t px = x * kSubpixels + kSubpixels / 2 - a.x, py = y * kSubpixels + kSubpixels / 2 - a.y;
    const double across = static_cast<double>(dx * py - dy * px) / kSubpixels;
    nearest =
        std::min(nearest, std::fabs(across) / std::hypot(static_cast<double>(dx), static_cast<double>(dy)));
  }
  return nearest;
}

}  // namespace halfspace::differential
