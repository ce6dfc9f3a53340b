// Sets lines of one pixel's width up, once for all tiles they go through.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "raster/primitive/line_packet.h"
#include "raster/primitive/segment.h"
#include "raster/tile/setup_batch.h"

namespace halfspace::raster {

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

// ends: two vertices for each of `count` <= kSetupLanes lines of the draw, none of which is cut.
using SetUpLinesFunction = void (*)(const DrawRecord& draw, const uint32_t* ends, int count, LineGroup& out);
SetUpLinesFunction set_up_lines();

}  // namespace halfspace::raster
