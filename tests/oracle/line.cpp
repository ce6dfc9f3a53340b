#include "tests/oracle/line.h"

#include <algorithm>
#include <cstdlib>

namespace halfspace::oracle {
namespace {

constexpr int64_t kHalf = 128;  // of a pixel: from a diamond's centre to its corners

// a + b e + c e^2 for an e > 0 that is smaller than any number.
struct Tiny {
  int64_t a, b = 0, c = 0;
  int sign() const { return a != 0 ? (a < 0 ? -1 : 1) : b != 0 ? (b < 0 ? -1 : 1) : c < 0 ? -1 : c > 0; }
  Tiny size() const { return sign() < 0 ? Tiny{-a, -b, -c} : *this; }
};
Tiny operator+(const Tiny& p, const Tiny& q) { return {p.a + q.a, p.b + q.b, p.c + q.c}; }
bool operator<(const Tiny& p, int64_t q) { return Tiny{p.a - q, p.b, p.c}.sign() < 0; }

// A segment as seen from a pixel's centre, its ends moved by (-e, -e^2).
struct SeenSegment {
  Tiny x0, y0, x1, y1;
  int64_t dx, dy;

  SeenSegment(const Place<int64_t>& a, const Place<int64_t>& b, int64_t px, int64_t py)
      : x0{a.x - px * 256 - kHalf, -1},
        y0{a.y - py * 256 - kHalf, 0, -1},
        x1{b.x - px * 256 - kHalf, -1},
        y1{b.y - py * 256 - kHalf, 0, -1},
        dx(b.x - a.x),
        dy(b.y - a.y) {}

  // x0 y1 - x1 y0.
  Tiny turn() const { return {x0.a * y1.a - x1.a * y0.a, -dy, dx}; }
  bool ends_inside() const { return x1.size() + y1.size() < kHalf; }
  // |x| + |y| is convex along the segment; its least value is at an end, or where x or y is 0.
  bool meets_diamond() const {
    if (x0.size() + y0.size() < kHalf || ends_inside()) return true;
    const bool crosses_x = x0.sign() != x1.sign(), crosses_y = y0.sign() != y1.sign();
    return (crosses_x && turn().size() < kHalf * std::abs(dx)) ||
           (crosses_y && turn().size() < kHalf * std::abs(dy));
  }
  bool makes_fragment() const { return meets_diamond() && !ends_inside(); }
};

int64_t floor_div(int64_t a, int64_t b) { return a / b - (a % b != 0 && (a < 0) != (b < 0)); }

}  // namespace

std::vector<LinePixel> line_pixels(const Place<int64_t>& a, const Place<int64_t>& b) {
  std::vector<LinePixel> pixels;
  const bool x_major = is_x_major(a, b);
  const int64_t u0 = x_major ? a.x : a.y, v0 = x_major ? a.y : a.x;
  const int64_t du = x_major ? b.x - a.x : b.y - a.y, dv = x_major ? b.y - a.y : b.x - a.x;
  if (du == 0) return pixels;
  const int64_t first = floor_div(std::min(u0, u0 + du), 256) - 1,
                last = floor_div(std::max(u0, u0 + du), 256) + 1;
  for (int64_t u = first; u <= last; ++u) {
    // Where the line crosses the middle of this column, and the pixels about that.
    const int64_t v = floor_div(v0 * du + dv * (u * 256 + kHalf - u0), du * 256);
    for (int64_t w = v - 1; w <= v + 1; ++w) {
      const int64_t px = x_major ? u : w, py = x_major ? w : u;
      if (SeenSegment(a, b, px, py).makes_fragment())
        pixels.push_back({static_cast<int>(px), static_cast<int>(py)});
    }
  }
  if (du < 0) std::reverse(pixels.begin(), pixels.end());
  return pixels;
}

}  // namespace halfspace::oracle
