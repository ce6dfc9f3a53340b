// Lines of one pixel's width, set up and ready to be fragments. Plain, for the per-ISA kernels.
#pragma once

#include <cstddef>
#include <cstdint>

#include "raster/primitive/segment.h"
#include "raster/tile/setup_batch.h"

namespace halfspace::raster {

// Where a line may be drawn, along its longer axis and along the other, in pixels.
struct LineWindow {
  int32_t u0, u1, v0, v1;

  LineWindow(const Rect& of, bool steep)
      : u0(steep ? of.y0 : of.x0),
        u1(steep ? of.y1 : of.x1),
        v0(steep ? of.x0 : of.y0),
        v1(steep ? of.x1 : of.y1) {}
};

// What of a line lies in a tile: one fragment in each of its columns, which cross the line's longer axis.
// Behind this stand, where the draw reads depths, its plane in double, and then the planes from 1/w on, or
// from the first attribute on where w is constant, in float: each as f0, dfdy, dfdx.
struct LinePacket {
  // Where the line is along its shorter axis, in pixels, at the middle of column `first`; and by how much it
  // moves from column to column. A column's fragment lies where this comes to, rounded down (LineColumns).
  double place, step;
  // Middle of pixel (0, 0) minus the vertex that its planes refer to, in pixels: exact.
  float anchor_x, anchor_y;
  int32_t first;
  uint32_t shape;

  static constexpr uint32_t kSteep = 1u << 16;  // `shape`; below it, how many columns
  static constexpr int kVariantAt = 17, kBytesAt = 24;
  static constexpr uint32_t kVariantBits = 3u << kVariantAt;
  static constexpr uint32_t kLevelAlpha = 1u << 19;  // its plane has no slope
  int count() const { return static_cast<int>(shape & 0xffff); }
  bool steep() const { return (shape & kSteep) != 0; }
  unsigned variant() const { return shape >> kVariantAt & 3; }
  bool alpha_is_level() const { return (shape & kLevelAlpha) != 0; }
  uint32_t bytes() const { return shape >> kBytesAt << 3; }

  // Those in float; of a draw that reads no depths.
  const float* planes() const { return reinterpret_cast<const float*>(this + 1); }
  // The first of them.
  static constexpr int first_plane(unsigned variant) { return (variant & kAffine) != 0 ? 2 : 1; }

  // The pixel along the shorter axis of the fragment in column first + `i`.
  int row(int i) const { return rounded_down(place + step * static_cast<double>(i)); }

  // Keeps the columns with fragments in the window. False: there are none.
  bool cut_to(const LineWindow& window) {
    int from = window.u0 > first ? window.u0 - first : 0;
    int end = window.u1 - first < count() ? window.u1 - first : count();
    if (from >= end) return false;
    const int begins = side(row(from), window), ends = side(row(end - 1), window);
    if (begins == ends && begins != 0) return false;
    // Otherwise it gets in somewhere between, or out, or both.
    if (begins != 0) from = column_beyond(begins < 0 ? window.v0 : window.v1);
    if (ends != 0) end = column_beyond(ends < 0 ? window.v0 : window.v1);
    place += step * static_cast<double>(from);
    first += from;
    shape = (shape & ~0xffffu) | static_cast<uint32_t>(end - from);
    return true;
  }

 private:
  static int rounded_down(double v) {
    const auto cut = static_cast<int>(v);
    return cut - (v < cut ? 1 : 0);
  }
  static int side(int v, const LineWindow& window) { return v < window.v0 ? -1 : v >= window.v1 ? 1 : 0; }
  // The first column on the other side of where pixel `v` begins. In none does the line come to just there.
  int column_beyond(int v) const { return rounded_down((v - place) / step) + 1; }
};
static_assert(sizeof(LinePacket) == 32);

inline constexpr size_t line_packet_bytes(int planes, bool has_depth) {
  const size_t bytes =
      sizeof(LinePacket) + (has_depth ? 3 * sizeof(double) : 0) + static_cast<size_t>(planes) * 12;
  return (bytes + 7) & ~size_t{7};
}

inline constexpr size_t kMostLineBytes = line_packet_bytes(kMaxPlanes - 1, true);

}  // namespace halfspace::raster
