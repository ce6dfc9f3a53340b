// Lines and points of size 1, exact in integers.
#include <algorithm>
#include <cstdlib>

#include "raster/tile/coverage.h"

namespace halfspace::raster {
namespace {

constexpr int64_t kHalf = kSubpixelScale / 2;  // of a pixel: the diamond's half diagonal

// Spec 3.4.1 moves both ends by (-e, -e^2), e as small as it takes. A linear form a*x + b*y + c that is zero
// then has the sign of what it loses: -a, or else -b. This is that sign, never 0 unless a and b are.
int sign_moved(int64_t value, int64_t a, int64_t b) {
  if (value != 0) return value < 0 ? -1 : 1;
  if (a != 0) return a > 0 ? -1 : 1;
  if (b != 0) return b > 0 ? -1 : 1;
  return 0;
}

struct Line {
  int64_t x0, y0, dx, dy;

  // Inside the open diamond |x - cx| + |y - cy| < 1/2.
  static bool is_point_in_diamond(int64_t x, int64_t y, int64_t cx, int64_t cy) {
    for (int sx : {-1, 1}) {
      for (int sy : {-1, 1}) {
        if (sign_moved(sx * (x - cx) + sy * (y - cy) - kHalf, sx, sy) >= 0) return false;
      }
    }
    return true;
  }

  // Does the segment, projected on (1, sy), meet the open interval the diamond projects to?
  bool spans(int64_t cx, int64_t cy, int sy) const {
    const int64_t a = (x0 - cx) + sy * (y0 - cy), b = a + dx + sy * dy;
    const bool above = sign_moved(std::max(a, b) + kHalf, 1, sy) > 0;
    const bool below = sign_moved(std::min(a, b) - kHalf, 1, sy) < 0;
    return above && below;
  }

  // Does the infinite line pass through the open diamond? Its distance, times its length, against the
  // diamond's support in the direction of its normal (dy, -dx).
  bool crosses(int64_t cx, int64_t cy) const {
    const int64_t offset = dy * (x0 - cx) - dx * (y0 - cy);
    const int64_t reach = kHalf * std::max(std::abs(dx), std::abs(dy));
    return sign_moved(offset - reach, dy, -dx) < 0 && sign_moved(offset + reach, dy, -dx) > 0;
  }

  // Separating axes of a diamond and a segment: the diamond's two and the segment's normal.
  bool makes_fragment(int64_t px, int64_t py) const {
    const int64_t cx = px * kSubpixelScale + kHalf, cy = py * kSubpixelScale + kHalf;
    return crosses(cx, cy) && spans(cx, cy, 1) && spans(cx, cy, -1) &&
           !is_point_in_diamond(x0 + dx, y0 + dy, cx, cy);
  }
};

int64_t floor_div(int64_t a, int64_t b) {  // b > 0
  const int64_t q = a / b;
  return q - (a % b < 0);
}

void set_pixel(TileCoverage& out, int x, int y) {
  const int block = y / kBlockSize * (kTileSize / kBlockSize) + x / kBlockSize;
  const uint64_t bit = uint64_t{1} << block;
  if (!(out.touched & bit)) out.blocks[block] = 0;
  out.touched |= bit;
  out.blocks[block] |= uint64_t{1} << (y % kBlockSize * kBlockSize + x % kBlockSize);
}

// One more pixel than a coordinate range holds on either side: a diamond there may still be met.
struct Span {
  int first, last;
};
Span pixels_met(int64_t from, int64_t to, int low, int high) {
  const int64_t first = (std::min(from, to) >> kSubpixelBits) - 1,
                last = (std::max(from, to) >> kSubpixelBits) + 1;
  return {int(std::max<int64_t>(first, low)), int(std::min<int64_t>(last, high - 1))};
}

}  // namespace

void cover_line(int32_t x0, int32_t y0, int32_t x1, int32_t y1, int tile_x, int tile_y, const Rect& bounds,
                TileCoverage& out) {
  out.touched = 0;
  const Line line{x0, y0, int64_t{x1} - x0, int64_t{y1} - y0};
  const Rect area = intersect(bounds, {tile_x, tile_y, tile_x + kTileSize, tile_y + kTileSize});
  if (area.empty() || (line.dx == 0 && line.dy == 0)) return;

  // Walk the longer direction, `u`. In each column the line passes within half a pixel of one centre, or of
  // two when it runs exactly between them.
  const bool steep = std::abs(line.dy) > std::abs(line.dx);
  const int64_t du = steep ? line.dy : line.dx, dv = steep ? line.dx : line.dy;
  const int64_t u0 = steep ? line.y0 : line.x0, v0 = steep ? line.x0 : line.y0;
  const int u_low = steep ? area.y0 : area.x0, u_high = steep ? area.y1 : area.x1;
  const int v_low = steep ? area.x0 : area.y0, v_high = steep ? area.x1 : area.y1;
  const Span span = pixels_met(u0, u0 + du, u_low, u_high);
  for (int u = span.first; u <= span.last; ++u) {
    // v at the column's centre, times |du|: below 2^49.
    const int64_t at = int64_t{u} * kSubpixelScale + kHalf - u0;
    const int64_t scaled = v0 * std::abs(du) + (du < 0 ? -dv : dv) * at;
    const int64_t pitch = std::abs(du) * kSubpixelScale;
    const int64_t v = floor_div(scaled, pitch);
    const bool between = v * pitch == scaled;
    for (int64_t candidate = v - between; candidate <= v; ++candidate) {
      if (candidate < v_low || candidate >= v_high) continue;
      const int c = int(candidate), px = steep ? c : u, py = steep ? u : c;
      if (line.makes_fragment(px, py)) set_pixel(out, px - tile_x, py - tile_y);
    }
  }
}

void cover_point(int32_t x, int32_t y, int tile_x, int tile_y, const Rect& bounds, TileCoverage& out) {
  out.touched = 0;
  const int px = x >> kSubpixelBits, py = y >> kSubpixelBits;
  const Rect area = intersect(bounds, {tile_x, tile_y, tile_x + kTileSize, tile_y + kTileSize});
  if (px < area.x0 || px >= area.x1 || py < area.y0 || py >= area.y1) return;
  set_pixel(out, px - tile_x, py - tile_y);
}

}  // namespace halfspace::raster
