// Lines of one pixel's width, set up and ready to be fragments. Plain, for the per-ISA kernels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "raster/tile/setup_batch.h"

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

// What packets of eight lines are made of, in pieces as vectors store them; and where they belong.
struct alignas(64) LineGroup {
  double place[kSetupLanes][2];  // and step
  float anchor[kSetupLanes]
              [4];  // x, y, and the bits of `first` and of `shape` without the variant and the size
  double depth[kSetupLanes][4];
  float plane[kMaxPlanes][kSetupLanes][4];  // f0, dfdy, dfdx
  alignas(32) uint32_t shape[kSetupLanes];
  int plane_end;
  bool has_depth;
  // Tiles its fragments within the draw's bounds lie in, inclusive; none where the second is less than the
  // first.
  alignas(32) int32_t tile_x0[kSetupLanes], tile_y0[kSetupLanes], tile_x1[kSetupLanes], tile_y1[kSetupLanes];

  SetupBatch planes;  // which the pieces are made from; the variants are looked up here

  bool is_drawn(int lane) const { return tile_x0[lane] <= tile_x1[lane] && tile_y0[lane] <= tile_y1[lane]; }
  bool needs_double(int lane) const { return (planes.variant[lane] & kDouble) != 0; }

  // Gives where the packet ends. Pieces of 16 bytes, of which the last are overwritten by the next.
  std::byte* write(int lane, std::byte* to) const {
    const int first = (planes.variant[lane] & kAffine) != 0 ? 2 : 1;
    const size_t bytes = line_packet_bytes(plane_end - first, has_depth);
    std::byte* const end = to + bytes;
    std::memcpy(to, place[lane], 16);
    std::memcpy(to + 16, anchor[lane], 16);
    const uint32_t word = shape[lane] |
                          static_cast<uint32_t>(planes.variant[lane]) << LinePacket::kVariantAt |
                          static_cast<uint32_t>(bytes / 8) << LinePacket::kBytesAt;
    std::memcpy(to + offsetof(LinePacket, shape), &word, sizeof word);
    to += sizeof(LinePacket);
    if (has_depth) {
      std::memcpy(to, depth[lane], 3 * sizeof(double));
      to += 3 * sizeof(double);
    }
    for (int p = first; p < plane_end - 1; ++p, to += 12) std::memcpy(to, plane[p][lane], 16);
    if (first < plane_end) std::memcpy(to, plane[plane_end - 1][lane], 12);
    return end;
  }
};

}  // namespace halfspace::raster
