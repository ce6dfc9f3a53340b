#include "tests/oracle/surface.h"

#include <algorithm>

namespace halfspace::oracle {
namespace {

using Wide3 = std::array<Wide, 3>;

// Spec 2.11.1: z_w = (f - n) / 2 * z_d + (n + f) / 2; times 2^24 - 1.
struct DepthRange {
  Wide scale, offset;
  explicit DepthRange(const raster::Viewport& v)
      : scale((wide(v.depth_far) - wide(v.depth_near)) / 2 * wide(kDepthSteps)),
        offset((wide(v.depth_near) + wide(v.depth_far)) / 2 * wide(kDepthSteps)) {}
  // A corner's own lies within the range.
  Wide of(const Corner& c) const {
    const Wide z = c.z / c.w * scale + offset, span = magnitude(scale);
    return held(z, offset - span, offset + span);
  }
};

// The three functions that are w_i at one corner and 0 at the others, each divided by w: affine over the
// window whatever the signs of w (rows of the inverse of the matrix with the columns (x w, y w, w)).
std::optional<std::array<Plane, 3>> weights(const Wide3& xw, const Wide3& yw, const Wide3& w) {
  std::array<Plane, 3> plane;
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3, k = (i + 2) % 3;
    plane[i] = {xw[j] * yw[k] - xw[k] * yw[j], yw[j] * w[k] - yw[k] * w[j], xw[k] * w[j] - xw[j] * w[k]};
  }
  const Wide determinant = w[0] * plane[0].base + w[1] * plane[1].base + w[2] * plane[2].base;
  if (determinant == 0 || !is_finite(determinant)) return std::nullopt;
  for (Plane& p : plane) p = {p.base / determinant, p.dx / determinant, p.dy / determinant};
  return plane;
}

Plane combine(const std::array<Plane, 3>& weight, const Wide3& f) {
  return {weight[0].base * f[0] + weight[1].base * f[1] + weight[2].base * f[2],
          weight[0].dx * f[0] + weight[1].dx * f[1] + weight[2].dx * f[2],
          weight[0].dy * f[0] + weight[1].dy * f[1] + weight[2].dy * f[2]};
}

Wide span(Wide x, Wide y) { return magnitude(x) + magnitude(y); }

}  // namespace

std::optional<Surface> Surface::of_triangle(const std::array<Corner, 3>& corners, const raster::Viewport& v,
                                            const std::array<Place<int64_t>, 3>* places) {
  Wide3 xw, yw, w, z;
  for (size_t i = 0; i < 3; ++i) {
    const Corner& c = corners[i];
    w[i] = c.w, z[i] = c.z;
    xw[i] = places ? c.w * wide((*places)[i].x) / 256 : (c.x + c.w) * wide(v.width) / 2 + wide(v.x) * c.w;
    yw[i] = places ? c.w * wide((*places)[i].y) / 256 : (c.y + c.w) * wide(v.height) / 2 + wide(v.y) * c.w;
  }
  const auto weight = weights(xw, yw, w);
  if (!weight) return std::nullopt;
  Surface s;
  s.inv_w_ = combine(*weight, {1, 1, 1});
  const DepthRange range(v);
  const Plane zw = combine(*weight, z);  // z / w
  s.depth_ = {zw.base * range.scale + range.offset, zw.dx * range.scale, zw.dy * range.scale};
  for (size_t k = 0; k < kValues; ++k) {
    const Wide3 f{corners[0].value[k], corners[1].value[k], corners[2].value[k]};
    if (f[0] == f[1] && f[0] == f[2]) s.constant_[k] = f[0];
    s.over_w_[k] = combine(*weight, f);
  }
  return s;
}

// Equation 3.5: t = (p_r - p_a) . (p_b - p_a) / |p_b - p_a|^2.
Surface Surface::of_line(const Corner& a, const Corner& b, const Place<Wide>& at_a, const Place<Wide>& at_b,
                         bool along_major, const raster::Viewport& viewport) {
  Wide dx = (at_b.x - at_a.x) / 256, dy = (at_b.y - at_a.y) / 256;
  if (along_major) (magnitude(dy) > magnitude(dx) ? dx : dy) = 0;
  const Wide square = dx * dx + dy * dy;
  const auto along = [&](Wide from, Wide to) {
    const Wide rate = square > 0 ? (to - from) / square : 0;
    Plane p{0, dx * rate, dy * rate};
    p.base = from - p.dx * at_a.x / 256 - p.dy * at_a.y / 256;
    return p;
  };
  Surface s;
  const DepthRange range(viewport);
  s.depth_ = along(range.of(a), range.of(b));
  s.inv_w_ = along(1 / a.w, 1 / b.w);
  for (size_t k = 0; k < kValues; ++k) {
    if (a.value[k] == b.value[k]) s.constant_[k] = a.value[k];
    s.over_w_[k] = along(a.value[k] / a.w, b.value[k] / b.w);
  }
  return s;
}

Surface Surface::of_point(const Corner& corner, const raster::Viewport& viewport) {
  Surface s;
  s.depth_.base = DepthRange(viewport).of(corner);
  s.inv_w_.base = 1;
  for (size_t k = 0; k < kValues; ++k) s.set_value(static_cast<ValuePlace>(k), corner.value[k]);
  return s;
}

void Surface::set_value(ValuePlace place, Wide value) {
  constant_[place] = value;
  over_w_[place] = {inv_w_.base * value, inv_w_.dx * value, inv_w_.dy * value};
}

Real Surface::steepest_depth() const { return real(std::max(magnitude(depth_.dx), magnitude(depth_.dy))); }

Real Surface::depth(int px, int py) const {
  return real(held(depth_.at(px, py), wide(0), wide(kDepthSteps)));
}

Affine<Real> Surface::quotient(const Plane& above, const Plane& below, int px, int py) const {
  const Wide w = below.at(px, py), value = above.at(px, py) / w;
  return {real(value), real((above.dx - value * below.dx) / w), real((above.dy - value * below.dy) / w)};
}

Affine<Real> Surface::value(ValuePlace place, int px, int py) const {
  if (constant_[place]) return {real(*constant_[place]), 0, 0};
  return quotient(over_w_[place], inv_w_, px, py);
}

Affine<Real> Surface::coord(ValuePlace place, int px, int py) const {
  if (constant_[place] && constant_[kCoordQ])
    return {*constant_[kCoordQ] == 0 ? 0 : real(*constant_[place] / *constant_[kCoordQ]), 0, 0};
  return quotient(over_w_[place], over_w_[kCoordQ], px, py);
}

bool may_leave_grid(const std::array<Corner, 3>& corners, const raster::Viewport& viewport,
                    const std::array<Place<int64_t>, 3>& snapped) {
  Outline<Wide> p;
  for (const Corner& c : corners) p.push_back(place_of(c, viewport));
  const Wide x1 = p[1].x - p[0].x, y1 = p[1].y - p[0].y, x2 = p[2].x - p[0].x, y2 = p[2].y - p[0].y;
  const Wide turn = twice_area(Outline<int64_t>(snapped.begin(), snapped.end())) < 0 ? -1 : 1;
  const Wide area = (x1 * y2 - x2 * y1) * turn;
  const Wide longest = std::max({span(x1, y1), span(x2, y2), span(x2 - x1, y2 - y1)});
  const Wide w[3] = {1 / corners[0].w, 1 / corners[1].w, 1 / corners[2].w};
  const Wide d1 = w[1] - w[0], d2 = w[2] - w[0];
  const Wide slope = span(d1 * y2 - d2 * y1, d2 * x1 - d1 * x2);
  // Over half a sub-pixel, where all lengths are in sub-pixels.
  return longest / 2 <= area / 4 && slope / 2 <= std::min({w[0], w[1], w[2]}) * area / 4;
}

bool line_may_leave_grid(const Corner& a, const Corner& b, const raster::Viewport& viewport) {
  const Place<Wide> from = place_of(a, viewport), to = place_of(b, viewport);
  const Wide x = to.x - from.x, y = to.y - from.y, half_area = (x * x + y * y) / 2;
  const Wide w[2] = {1 / a.w, 1 / b.w};
  return 2 * std::max(magnitude(x), magnitude(y)) <= half_area &&
         magnitude(w[1] - w[0]) * span(x, y) <= std::min(w[0], w[1]) * half_area;
}

}  // namespace halfspace::oracle
