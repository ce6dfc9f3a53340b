// Sets lines of one pixel's width up, once for all tiles they go through.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "raster/primitive/line_packet.h"
#include "raster/primitive/segment.h"
#include "raster/tile/setup_batch.h"
#include "raster/vertex/end_columns.h"

namespace halfspace::raster {

// What packets of eight lines are made of, in pieces as vectors store them; and where they belong.
struct alignas(64) LineGroup {
  // What lies in one tile: a line that is no longer than a tile comes in three parts at most.
  struct Part {
    double place[kSetupLanes][2];  // and step
    float anchor[kSetupLanes][4];  // x, y, and the bits of `first` and of `shape`
    alignas(32) int32_t count[kSetupLanes], x[kSetupLanes], y[kSetupLanes];  // of columns; and which tile
  };
  static constexpr int kParts = 3;
  Part parts[kParts];
  double depth[kSetupLanes][4];
  float plane[kMaxPlanes][kSetupLanes][4];  // f0, dfdy, dfdx
  int plane_end;
  bool has_depth;
  // Of all lines w is constant and four colours are all their planes: packets have these in a row, as here
  // each line has three quads of them from plane[2] on.
  bool has_quads;
  static constexpr int kQuads = 3;
  alignas(32) int32_t variant[kSetupLanes];
  // -1: of the line, which is longer or reaches beyond the draw's bounds, the first part is all.
  alignas(32) int32_t whole[kSetupLanes];
  // Tiles its fragments within the draw's bounds may lie in, inclusive; none where the second is less than
  // the first.
  alignas(32) int32_t tile_x0[kSetupLanes], tile_y0[kSetupLanes], tile_x1[kSetupLanes], tile_y1[kSetupLanes];

  bool is_drawn(int lane) const { return tile_x0[lane] <= tile_x1[lane] && tile_y0[lane] <= tile_y1[lane]; }
  bool needs_double(int lane) const { return (variant[lane] & kDouble) != 0; }

  // Of the first `count` lines: whether any needs more than that its parts are binned.
  bool has_special(int count) const {
    int special = 0;
    for (int lane = 0; lane < count; ++lane) special |= whole[lane] | (variant[lane] & kDouble);
    return special != 0;
  }
  // Which parts there are of them, a bit each: of line after line.
  static constexpr int kPlaces = 4;
  uint32_t parts_drawn(int count) const {
    uint32_t bits = 0;
    for (int lane = 0; lane < count; ++lane) {
      uint32_t of_line = 0;
      for (int k = 0; k < kParts; ++k) {
        const auto* const columns =
            parts[k].count;  // with -fsanitize=bounds g++ 12 takes count[lane] for uninitialized
        of_line |= (columns[lane] > 0 ? 1u : 0u) << k;
      }
      bits |= of_line << (kPlaces * lane);
    }
    return bits;
  }
  static constexpr uint32_t parts_of(int lane) { return ((1u << kPlaces) - 1) << (kPlaces * lane); }

  // Gives where the packet ends. Pieces of 16 bytes, of which the last are overwritten by the next.
  std::byte* write(int lane, const Part& part, std::byte* to) const {
    const int first = LinePacket::first_plane(static_cast<unsigned>(variant[lane]));
    std::byte* const end = to + line_packet_bytes(plane_end - first, has_depth);
    std::memcpy(to, part.place[lane], 16);
    std::memcpy(to + offsetof(LinePacket, anchor_x), part.anchor[lane], 16);
    to += sizeof(LinePacket);
    if (has_quads) {
      for (int q = 2; q < 2 + kQuads; ++q, to += 16) std::memcpy(to, plane[q][lane], 16);
      return to;
    }
    if (has_depth) {
      std::memcpy(to, depth[lane], 3 * sizeof(double));
      to += 3 * sizeof(double);
    }
    for (int p = first; p < plane_end - 1; ++p, to += 12) std::memcpy(to, plane[p][lane], 16);
    if (first < plane_end) std::memcpy(to, plane[plane_end - 1][lane], 12);
    return end;
  }

  // The same of what of all the line lies in the window; where that is nothing, gives `to`.
  std::byte* write_within(int lane, const Rect& window, std::byte* to) const {
    LinePacket packet;
    std::memcpy(&packet, parts[0].place[lane], 16);
    std::memcpy(&packet.anchor_x, parts[0].anchor[lane], 16);
    if (!packet.cut_to({window, packet.steep()})) return to;
    std::byte* const end = write(lane, parts[0], to);
    std::memcpy(to, &packet, sizeof packet);
    return end;
  }
};

// ends: two vertices for each of `count` <= kSetupLanes lines of the draw, none of which is cut.
using SetUpLinesFunction = void (*)(const DrawRecord& draw, const uint32_t* ends, int count, LineGroup& out);
SetUpLinesFunction set_up_lines();

// The same of lines that are columns, from the `first` on, a multiple of kSetupLanes.
using SetUpLineColumnsFunction = void (*)(const DrawRecord& draw, const EndColumns& ends, uint32_t first,
                                          int count, LineGroup& out);
SetUpLineColumnsFunction set_up_line_columns();

}  // namespace halfspace::raster
