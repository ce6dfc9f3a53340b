// Lines of one pixel's width, set up and ready to be fragments. Plain, for the per-ISA kernels.
#pragma once

#include <cstddef>
#include <cstdint>

#include "raster/primitive/segment.h"

namespace halfspace::raster {

// A line has one fragment in each of its columns, which cross its longer axis. Behind this stand, where the
// draw reads depths, its plane in double, and then the planes from 1/w on, or from the first attribute on
// where w is constant, in float: each as f0, dfdy, dfdx.
struct LinePacket {
  // Where the line is along its shorter axis, in pixels, at the middle of column `first`; and by how much it
  // moves from column to column. A column's fragment lies where this comes to, rounded down (LineColumns).
  double place, step;
  float anchor_x,
      anchor_y;  // middle of pixel (0, 0) minus the vertex that its planes refer to, in pixels: exact
  int32_t first;
  uint32_t shape;

  static constexpr uint32_t kSteep = 1u << 16;  // `shape`; below it, how many columns
  static constexpr int kVariantAt = 17, kBytesAt = 24;
  int count() const { return static_cast<int>(shape & 0xffff); }
  bool steep() const { return (shape & kSteep) != 0; }
  unsigned variant() const { return shape >> kVariantAt & 3; }
  uint32_t bytes() const { return shape >> kBytesAt << 3; }
};
static_assert(sizeof(LinePacket) == 32);

inline constexpr size_t line_packet_bytes(int planes, bool has_depth) {
  const size_t bytes =
      sizeof(LinePacket) + (has_depth ? 3 * sizeof(double) : 0) + static_cast<size_t>(planes) * 12;
  return (bytes + 7) & ~size_t{7};
}

inline constexpr size_t kMostLineBytes = line_packet_bytes(kMaxPlanes - 1, true);

}  // namespace halfspace::raster
