// Lines and points, exact in integers.
#include <algorithm>
#include <cstdlib>

#include "raster/tile/coverage.h"

namespace halfspace::raster {
namespace {

constexpr int64_t kNoRow = INT64_MIN;
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

// A line with its longer axis called u and the other one v.
struct AxisLine {
  Line line;
  bool steep;
  int64_t u0, v0, du, dv;

  AxisLine(const LineEnds& e, int width) {
    steep = std::abs(int64_t{e.y1} - e.y0) > std::abs(int64_t{e.x1} - e.x0);
    const int64_t shift = int64_t{width - 1} * kHalf;
    line = {e.x0 - (steep ? shift : 0), e.y0 - (steep ? 0 : shift), int64_t{e.x1} - e.x0,
            int64_t{e.y1} - e.y0};
    du = steep ? line.dy : line.dx, dv = steep ? line.dx : line.dy;
    u0 = steep ? line.y0 : line.x0, v0 = steep ? line.x0 : line.y0;
  }

  // In each column the line passes within half a pixel of one centre, or of two when it runs exactly between
  // them: the row of column u's fragment, or kNoRow.
  int64_t fragment(int64_t u) const {
    // v at the column's centre, times |du|: below 2^49.
    const int64_t at = u * kSubpixelScale + kHalf - u0;
    const int64_t scaled = v0 * std::abs(du) + (du < 0 ? -dv : dv) * at;
    const int64_t pitch = std::abs(du) * kSubpixelScale;
    const int64_t row = floor_div(scaled, pitch);
    return decide(u, row, row * pitch == scaled);
  }

  // The same where the line is known to be at `row` in the column's middle, `between`: exactly on its lower
  // edge. By value and kept out of the walk, so that the walk stays in registers.
  [[gnu::noinline]] int64_t decide(int64_t u, int64_t row, bool between) const {
    if (between && makes_fragment(u, row - 1)) return row - 1;
    return makes_fragment(u, row) ? row : kNoRow;
  }

  // The columns whose diamonds the line, once moved, reaches into: an end on the boundary of two is moved to the
  // lower one.
  int64_t first_column() const { return column_below(std::min(u0, u0 + du)); }
  int64_t last_column() const { return column_below(std::max(u0, u0 + du)); }

  // In columns [sure_from, sure_to] the line meets the middle, in a point of an open diamond unless exactly
  // between two, and does not end in one of the column's: there is a fragment, where the line is at the middle.
  int64_t sure_from() const {
    return ((std::min(u0, u0 + du) + (du < 0 ? kHalf : 0) - kHalf) >> kSubpixelBits) + 1;
  }
  int64_t sure_to() const {
    return ((std::max(u0, u0 + du) - (du > 0 ? kHalf : 0) + kHalf - 1) >> kSubpixelBits) - 1;
  }

 private:
  static int64_t column_below(int64_t u) { return ((u + kSubpixelScale - 1) >> kSubpixelBits) - 1; }
  bool makes_fragment(int64_t u, int64_t v) const {
    return steep ? line.makes_fragment(v, u) : line.makes_fragment(u, v);
  }
};

// The fragments of a line column by column; where nothing is to be decided, without a division.
class ColumnWalk {
 public:
  ColumnWalk(const AxisLine& line, int64_t first)
      : line_(line), u_(first), sure_from_(line.sure_from()), sure_to_(line.sure_to()) {
    const int64_t length = std::abs(line.du), rise = line.du < 0 ? -line.dv : line.dv;
    pitch_ = length * kSubpixelScale;
    const int64_t scaled = line.v0 * length + rise * (first * kSubpixelScale + kHalf - line.u0);
    v_ = floor_div(scaled, pitch_);
    rest_ = scaled - v_ * pitch_;
    step_ = rise * kSubpixelScale;  // at most a pitch, either way
  }
  int64_t u() const { return u_; }
  int64_t fragment() const {
    if (rest_ != 0 && u_ >= sure_from_ && u_ <= sure_to_) [[likely]]
      return v_;
    return line_.decide(u_, v_, rest_ == 0);
  }
  void next() {
    ++u_;
    rest_ += step_;
    // Without branches: which way it goes is as good as random.
    const int64_t up = rest_ >= pitch_, down = rest_ < 0;
    rest_ += (pitch_ & -down) - (pitch_ & -up);
    v_ += up - down;
  }

 private:
  const AxisLine& line_;
  int64_t u_, sure_from_, sure_to_;
  int64_t v_, rest_, step_, pitch_;  // at column u_ the line is at v_ + rest_ / pitch_
};

bool passes(const LineStipple& stipple, uint32_t index) {
  const uint32_t s = (stipple.start + index) / uint32_t(stipple.repeat);
  return stipple.pattern >> (s % 16) & 1;
}

}  // namespace

LineRun line_run(const LineEnds& ends, int width) {
  const AxisLine axis(ends, width);
  if (axis.du == 0) return {0, 0};
  int64_t low = axis.first_column(), high = axis.last_column();
  while (low <= high && axis.fragment(low) == kNoRow) ++low;
  while (high > low && axis.fragment(high) == kNoRow) --high;
  if (low > high) return {0, 0};
  return {int(axis.du > 0 ? low : high), uint32_t(high - low + 1)};
}

namespace {

// Calls visit(x, y), relative to the tile, for every pixel of the line.
template <class Visit>
void walk_line(const LineEnds& ends, int width, const LineStipple& stipple, int tile_x, int tile_y, const Rect& bounds,
               const Rect& middle, Visit visit) {
  const AxisLine axis(ends, width);
  const Rect area = intersect(bounds, {tile_x, tile_y, tile_x + kTileSize, tile_y + kTileSize});
  if (area.empty() || axis.du == 0) return;
  const LineRun run = stipple.on ? line_run(ends, width) : LineRun{0, 0};
  const bool steep = axis.steep;
  const int u_low = std::max(steep ? area.y0 : area.x0, steep ? middle.y0 : middle.x0);
  const int u_high = std::min(steep ? area.y1 : area.x1, steep ? middle.y1 : middle.x1);
  const int v_low = steep ? area.x0 : area.y0, v_high = steep ? area.x1 : area.y1;
  const int middle_low = steep ? middle.x0 : middle.y0, middle_high = steep ? middle.x1 : middle.y1;
  const int64_t last = std::min<int64_t>(axis.last_column(), u_high - 1);
  for (ColumnWalk walk(axis, std::max<int64_t>(axis.first_column(), u_low)); walk.u() <= last; walk.next()) {
    const int64_t v = walk.fragment();
    if (v == kNoRow) continue;
    const int64_t center = v + (width - 1) / 2;
    if (center < middle_low || center >= middle_high) continue;
    const int u = int(walk.u());
    if (stipple.on && !passes(stipple, uint32_t(std::abs(u - run.first)))) continue;
    const int64_t end = std::min<int64_t>(v + width, v_high);
    for (int64_t row = std::max<int64_t>(v, v_low); row < end; ++row) {
      const int w = int(row);
      visit((steep ? w : u) - tile_x, (steep ? u : w) - tile_y);
    }
  }
}

}  // namespace

void cover_line(const LineEnds& ends, int width, const LineStipple& stipple, int tile_x, int tile_y,
                const Rect& bounds, const Rect& middle, TileCoverage& out) {
  out.touched = 0;
  walk_line(ends, width, stipple, tile_x, tile_y, bounds, middle, [&](int x, int y) { set_pixel(out, x, y); });
}

Rect point_square(int32_t x, int32_t y, int size) {
  const int32_t even = size % 2 == 0 ? kSubpixelScale / 2 : 0;
  const int left = ((x + even) >> kSubpixelBits) - size / 2,
            bottom = ((y + even) >> kSubpixelBits) - size / 2;
  return {left, bottom, left + size, bottom + size};
}

void cover_point(int32_t x, int32_t y, int size, int tile_x, int tile_y, const Rect& bounds,
                 TileCoverage& out) {
  out.touched = 0;
  const Rect tile = intersect(bounds, {tile_x, tile_y, tile_x + kTileSize, tile_y + kTileSize});
  const Rect area = intersect(point_square(x, y, size), tile);
  for (int py = area.y0; py < area.y1; ++py) {
    for (int px = area.x0; px < area.x1; ++px) set_pixel(out, px - tile_x, py - tile_y);
  }
}

}  // namespace halfspace::raster
