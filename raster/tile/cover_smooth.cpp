#include "raster/tile/cover_smooth.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace halfspace::raster {
namespace {

constexpr double kPixel = 1.0 / kSubpixelScale;
constexpr double kLeast = 1e-6;  // of a pixel: less is rounding's work
constexpr int kDiscRows = 16;    // of a pixel, in which a disc's chords are measured

struct Point {
  double x, y;
};

// A pixel's square cut by half planes: at most a corner more for each.
struct Region {
  Point p[8];
  int count = 4;
  Region() : p{{0, 0}, {1, 0}, {1, 1}, {0, 1}} {}

  // Keeps where value + a x + b y >= 0.
  void cut(double value, double a, double b) {
    Point kept[8];
    int n = 0;
    for (int i = 0; i < count; ++i) {
      const Point &from = p[i], &to = p[i + 1 < count ? i + 1 : 0];
      const double d0 = value + a * from.x + b * from.y, d1 = value + a * to.x + b * to.y;
      if (d0 >= 0) kept[n++] = from;
      if ((d0 >= 0) != (d1 >= 0)) {
        const double t = d0 / (d0 - d1);
        kept[n++] = {from.x + (to.x - from.x) * t, from.y + (to.y - from.y) * t};
      }
    }
    std::copy_n(kept, n, p);
    count = n;
  }

  double area() const {
    double twice = 0;
    for (int i = 1; i + 1 < count; ++i) {
      const double ax = p[i].x - p[0].x, ay = p[i].y - p[0].y, bx = p[i + 1].x - p[0].x,
                   by = p[i + 1].y - p[0].y;
      twice += ax * by - bx * ay;
    }
    return twice * 0.5;
  }
};

double value_at(const SmoothShape::Edge& e, double x, double y) { return e.a * x + e.b * y + e.c; }
double rise(const SmoothShape::Edge& e) { return std::max(e.a, 0.0) + std::max(e.b, 0.0); }
double fall(const SmoothShape::Edge& e) { return std::min(e.a, 0.0) + std::min(e.b, 0.0); }

// The part of the unit square at (x, y) that lies inside all edges.
double convex_area(const SmoothShape& s, double x, double y) {
  bool crossed = false;
  for (int k = 0; k < s.edge_count; ++k) {
    const double value = value_at(s.edges[k], x, y);
    if (value + rise(s.edges[k]) <= 0) return 0;
    crossed = crossed || value + fall(s.edges[k]) < 0;
  }
  if (!crossed) return 1;
  Region region;
  for (int k = 0; k < s.edge_count && region.count > 2; ++k) {
    const SmoothShape::Edge& e = s.edges[k];
    region.cut(value_at(e, x, y), e.a, e.b);
  }
  return region.area();
}

// Each element of the pattern is a rectangle of its own, `repeat` pixels of the line long.
double stippled_area(const SmoothShape& s, double x, double y) {
  const SmoothShape::Edge& along = s.edges[2];
  const double at = value_at(along, x, y), repeat = s.stipple.repeat,
               start = double(s.stipple.start) * kPixel;
  const double low = std::max(at + fall(along), 0.0), high = std::min(at + rise(along), s.length);
  double area = 0;
  const auto element = [&](double t) { return int64_t(std::floor((start + t) / repeat)); };
  for (int64_t k = element(low); low < high && k <= element(high); ++k) {
    if (!(s.stipple.pattern >> (k % 16) & 1)) continue;
    const double from = std::max(double(k) * repeat - start, 0.0),
                 to = std::min(double(k + 1) * repeat - start, s.length);
    if (!(from < to)) continue;
    SmoothShape part = s;
    part.edges[2].c -= from;
    part.edges[3].c = to;
    area += convex_area(part, x, y);
  }
  return area;
}

double disc_area(double radius, double x, double y) {
  const double far_x = std::max(std::abs(x), std::abs(x + 1)), far_y = std::max(std::abs(y), std::abs(y + 1));
  if (far_x * far_x + far_y * far_y <= radius * radius) return 1;
  double area = 0;
  for (int row = 0; row < kDiscRows; ++row) {
    const double v = y + (row + 0.5) / kDiscRows, h2 = radius * radius - v * v;
    if (h2 <= 0) continue;
    const double half = std::sqrt(h2);
    area += std::max(std::min(x + 1, half) - std::max(x, -half), 0.0);
  }
  return area / kDiscRows;
}

// atan t for t >= 0, to within a few units of the last place: by the series, on [-(sqrt 2 - 1), sqrt 2 - 1].
double arc_tangent(double t) {
  constexpr double kQuarter = 0.78539816339744830962;
  if (t > 1) return 2 * kQuarter - arc_tangent(1 / t);
  const bool large = t > 0.4142135623730951;
  const double v = large ? (t - 1) / (t + 1) : t, v2 = v * v;
  double sum = 0;
  for (int k = 22; k >= 0; --k) sum = 1.0 / (2 * k + 1) - v2 * sum;
  return (large ? kQuarter : 0) + v * sum;
}

// Integral of sqrt(r^2 - x^2) from 0 to x, |x| <= r.
double under_arc(double radius, double x) {
  const double height = std::sqrt(std::max(radius * radius - x * x, 0.0)), reach = std::abs(x);
  const double angle = height > 0 ? arc_tangent(reach / height) : 1.57079632679489661923;
  return std::copysign(0.5 * (reach * height + radius * radius * angle), x);
}

// The same area by its integral, piece by piece: where the arc crosses an edge of the pixel, another piece
// begins.
double exact_disc_area(double radius, double x, double y) {
  const double low = std::max(x, -radius), high = std::min(x + 1, radius);
  if (!(low < high)) return 0;
  double ends[6] = {low, high};  // in order
  int count = 2;
  const auto insert = [&](double at) {
    int place = count++;
    for (; ends[place - 1] > at; --place) ends[place] = ends[place - 1];  // low stays first
    ends[place] = at;
  };
  for (const double edge : {y, y + 1}) {
    const double square = radius * radius - edge * edge;
    if (square <= 0) continue;
    for (const double at : {-std::sqrt(square), std::sqrt(square)}) {
      if (at > low && at < high) insert(at);
    }
  }
  double area = 0;
  for (int i = 0; i + 1 < count; ++i) {
    const double from = ends[i], to = ends[i + 1], middle = (from + to) * 0.5;
    const double height = std::sqrt(std::max(radius * radius - middle * middle, 0.0));
    if (std::min(height, y + 1) <= std::max(-height, y)) continue;
    const double arc = under_arc(radius, to) - under_arc(radius, from), width = to - from;
    area += (height < y + 1 ? arc : (y + 1) * width) - (-height > y ? -arc : y * width);
  }
  return area;
}

bool is_covered(const SmoothShape& s, double x, double y) {
  if (s.radius > 0) return x * x + y * y <= s.radius * s.radius;
  for (int k = 0; k < s.edge_count; ++k) {
    if (value_at(s.edges[k], x, y) < 0) return false;
  }
  if (!s.stipple.on) return true;
  const double along = value_at(s.edges[2], x, y) + double(s.stipple.start) * kPixel;
  return s.stipple.pattern >> (int64_t(along / s.stipple.repeat) % 16) & 1;
}

double sampled_area(const SmoothShape& s, double x, double y) {
  int inside = 0;
  for (int i = 0; i < 16; ++i) inside += is_covered(s, x + (i % 4 + 0.5) / 4, y + (i / 4 + 0.5) / 4);
  return inside / 16.0;
}

double covered(const SmoothShape& s, double x, double y) {
  if (s.level == Level::draft) return sampled_area(s, x, y);
  if (s.level == Level::exact && s.radius > 0) return exact_disc_area(s.radius, x, y);
  if (s.radius > 0) return disc_area(s.radius, x, y);
  return s.stipple.on ? stippled_area(s, x, y) : convex_area(s, x, y);
}

Rect box_around(double x0, double y0, double x1, double y1) {
  return {int(std::floor(x0)), int(std::floor(y0)), int(std::ceil(x1)), int(std::ceil(y1))};
}

bool is_lower(int32_t x, int32_t y, int32_t than_x, int32_t than_y) {
  return y != than_y ? y < than_y : x < than_x;
}

}  // namespace

SmoothShape smooth_triangle(const int32_t (&x)[3], const int32_t (&y)[3]) {
  // From the lowest corner counter-clockwise, so that the order the corners came in changes no bit.
  int first = 0;
  for (int k = 1; k < 3; ++k) {
    if (is_lower(x[k], y[k], x[first], y[first])) first = k;
  }
  int order[3] = {first, (first + 1) % 3, (first + 2) % 3};
  const auto area = int64_t{x[1] - x[0]} * (y[2] - y[0]) - int64_t{x[2] - x[0]} * (y[1] - y[0]);
  if (area < 0) std::swap(order[1], order[2]);
  SmoothShape s{};
  s.anchor_x = x[first], s.anchor_y = y[first];
  s.edge_count = 3;
  for (int k = 0; k < 3; ++k) {
    const int from = order[k], to = order[(k + 1) % 3];
    const double dx = (x[to] - x[from]) * kPixel, dy = (y[to] - y[from]) * kPixel;
    const double px = (x[from] - s.anchor_x) * kPixel, py = (y[from] - s.anchor_y) * kPixel;
    s.edges[k] = {-dy, dx, dy * px - dx * py};  // exact: 24 bits each
  }
  s.box = box_around(std::min({x[0], x[1], x[2]}) * kPixel, std::min({y[0], y[1], y[2]}) * kPixel,
                     std::max({x[0], x[1], x[2]}) * kPixel, std::max({y[0], y[1], y[2]}) * kPixel);
  return s;
}

SmoothShape smooth_line(const LineEnds& ends, double width, const LineStipple& stipple) {
  LineEnds e = ends;
  if (!stipple.on && is_lower(e.x1, e.y1, e.x0, e.y0)) e = {e.x1, e.y1, e.x0, e.y0};
  SmoothShape s{};
  s.anchor_x = e.x0, s.anchor_y = e.y0;
  s.edge_count = 4;
  s.stipple = stipple;
  const double dx = (e.x1 - e.x0) * kPixel, dy = (e.y1 - e.y0) * kPixel;
  s.length = std::sqrt(dx * dx + dy * dy);
  const double ux = dx / s.length, uy = dy / s.length, half = width * 0.5;
  s.edges[0] = {-uy, ux, half};
  s.edges[1] = {uy, -ux, half};
  s.edges[2] = {ux, uy, 0};
  s.edges[3] = {-ux, -uy, s.length};
  const double rx = std::abs(uy) * half, ry = std::abs(ux) * half;
  s.box = box_around(std::min(e.x0, e.x1) * kPixel - rx, std::min(e.y0, e.y1) * kPixel - ry,
                     std::max(e.x0, e.x1) * kPixel + rx, std::max(e.y0, e.y1) * kPixel + ry);
  return s;
}

SmoothShape smooth_point(int32_t x, int32_t y, double size) {
  SmoothShape s{};
  s.anchor_x = x, s.anchor_y = y;
  s.radius = size * 0.5;
  s.box =
      box_around(x * kPixel - s.radius, y * kPixel - s.radius, x * kPixel + s.radius, y * kPixel + s.radius);
  return s;
}

uint64_t cover_block(const SmoothShape& s, int x, int y, float (&coverage)[64]) {
  const double left = x - s.anchor_x * kPixel, bottom = y - s.anchor_y * kPixel;
  for (int k = 0; k < s.edge_count; ++k) {
    if (value_at(s.edges[k], left, bottom) + kBlockSize * rise(s.edges[k]) <= 0) return 0;
  }
  uint64_t mask = 0;
  for (int i = 0; i < 64; ++i) {
    const int column = i % kBlockSize, row = i / kBlockSize;
    coverage[i] = 0;
    if (x + column < s.box.x0 || x + column >= s.box.x1 || y + row < s.box.y0 || y + row >= s.box.y1)
      continue;
    const double part = covered(s, left + column, bottom + row);
    if (part < kLeast) continue;
    coverage[i] = float(std::min(part, 1.0));
    mask |= uint64_t{1} << i;
  }
  return mask;
}

}  // namespace halfspace::raster
