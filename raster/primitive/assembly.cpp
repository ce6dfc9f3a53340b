#include "raster/primitive/assembly.h"

#include <bit>
#include <cstring>
#include <optional>
#include <type_traits>

#include "raster/fragment/program.h"
#include "raster/primitive/clip.h"
#include "raster/primitive/cut_faces.h"
#include "raster/primitive/packet_run.h"
#include "raster/primitive/patterns.h"
#include "raster/primitive/shape_assembly.h"
#include "raster/primitive/triangle_filter.h"
#include "raster/primitive/window_box.h"
#include "raster/surface/framebuffer.h"
#include "raster/tile/line_setup.h"
#include "raster/tile/settled_planes.h"
#include "raster/vertex/vertex_stage.h"

namespace halfspace::raster {

uint32_t primitive_count(Primitive mode, uint32_t n) {
  switch (mode) {
    case Primitive::points:
      return n;
    case Primitive::lines:
      return n / 2;
    case Primitive::line_loop:
      return n < 2 ? 0 : n;
    case Primitive::line_strip:
      return n < 2 ? 0 : n - 1;
    case Primitive::triangles:
      return n / 3;
    case Primitive::triangle_strip:
    case Primitive::triangle_fan:
    case Primitive::polygon:
      return n < 3 ? 0 : n - 2;
    case Primitive::quads:
      return n / 4 * 2;
    case Primitive::quad_strip:
      return n < 4 ? 0 : (n - 2) / 2 * 2;
  }
  return 0;
}

namespace {

class Assembler {
 public:
  Assembler(const DrawRecord& draw, const uint32_t* indices, uint32_t index_count, Segment& segment)
      : draw_(draw),
        segment_(segment),
        indices_(indices),
        index_count_(index_count),
        records_(draw.vertices.records),
        stride_(draw.vertices.layout.stride()),
        outcodes_(draw.vertices.outcodes.data()),
        bounds_(draw.bounds),
        facing_(draw.state->raster),
        base_(indices ? draw.first_vertex : 0),
        filter_{records_,        stride_,          base_,          outcodes_, bounds_,
                facing_.cull_cw, facing_.cull_ccw, segment.tiles_x} {}

  template <class Pattern>
  void faces(uint32_t first, uint32_t count) {
    segment_.triangles_in += count;
    const TriangleFilterFunction run_filter = triangle_filter();
    uint32_t made[3 * kFilterLanes];
    FilteredTriangles found;
    for (; count > 0; first += kFilterLanes) {
      const uint32_t group = std::min(count, kFilterLanes);
      const uint32_t* corners = corners_of<Pattern>(first, group, made);
      run_filter(filter_, corners, group, found);
      if (found.special != 0) return cut_faces<Pattern>(first, count);
      take_filtered(found, corners, Pattern::kProvoking, nullptr);
      count -= group;
    }
  }

  void lines(Primitive mode, uint32_t first, uint32_t count) {
    if (draw_.runs_lines) return run_lines(mode, first, count);
    for (uint32_t k = first; k < first + count; ++k) {
      const LineVertices v = line_vertices(mode, k);
      line(v.from, v.to);
    }
  }

  void points(uint32_t first, uint32_t count) {
    if (draw_.runs_points) return run_points(first, count);
    for (uint32_t k = first; k < first + count; ++k) {
      const uint32_t v = vertex(k);
      int px, py;
      if (is_point_seen(v, px, py))
        push_to_bin(segment_, px / kTileSize, py / kTileSize,
                    append({{v, v, v}, PrimitiveKind::point, false, false, 0}));
    }
  }

 private:
  // Of a group of triangles, as the draw calls them; `made`: where they go that are not in memory as they
  // are.
  template <class Pattern>
  const uint32_t* corners_of(uint32_t first, uint32_t group, uint32_t* made) const {
    if (std::is_same_v<Pattern, ListTriangles> && indices_ != nullptr) return indices_ + 3 * first;
    for (uint32_t i = 0; i < group; ++i) {
      const Corners at = Pattern::at(first + i);
      for (uint32_t k = 0; k < 3; ++k) made[3 * i + k] = name(at.v[k]);
    }
    return made;
  }

  // From the first group on that has triangles to be cut. Groups wait from each such on, so that these come
  // together. Apart from faces(), since small draws should not have to clear its memory.
  template <class Pattern>
  [[gnu::noinline]] void cut_faces(uint32_t first, uint32_t count) {
    const TriangleFilterFunction run_filter = triangle_filter();
    constexpr uint32_t kGroups = CutFaces::kMost / kFilterLanes;
    uint32_t made[kGroups][3 * kFilterLanes];
    const uint32_t* corners[kGroups];
    FilteredTriangles found[kGroups];
    CutFaces cut(draw_, clipper(), facing_, segment_);
    uint32_t waiting = 0;
    const auto take_waiting = [&] {
      cut.cut();
      for (uint32_t i = 0; i < waiting; ++i) take_filtered(found[i], corners[i], Pattern::kProvoking, &cut);
      waiting = 0;
    };
    for (; count > 0; first += kFilterLanes) {
      const uint32_t group = std::min(count, kFilterLanes);
      corners[waiting] = corners_of<Pattern>(first, group, made[waiting]);
      run_filter(filter_, corners[waiting], group, found[waiting]);
      count -= group;
      if ((waiting | found[waiting].special) == 0) {
        take_filtered(found[0], corners[0], Pattern::kProvoking, nullptr);
        continue;
      }
      add_cut(found[waiting].special, corners[waiting], Pattern::kProvoking, cut);
      if (++waiting == kGroups) take_waiting();
    }
    if (waiting != 0) take_waiting();
  }

  // What the draw calls a vertex, and which of those here it is.
  uint32_t name(uint32_t place) const { return indices_ ? indices_[place] : place; }
  uint32_t vertex(uint32_t place) const { return name(place) - base_; }
  const VertexHead& head(uint32_t i) const {
    return *reinterpret_cast<const VertexHead*>(records_ + size_t{i} * stride_);
  }

  uint32_t append(const PrimitiveRef& ref) {
    segment_.primitives.push_back(ref);
    return uint32_t(segment_.primitives.size() - 1);
  }

  const Clipper& clipper() {
    if (!clipper_) clipper_.emplace(draw_);
    return *clipper_;
  }

  void add_cut(uint32_t lanes, const uint32_t* corners, uint8_t provoking, CutFaces& cut) const {
    for (; lanes != 0; lanes &= lanes - 1) {
      const uint32_t* named = corners + 3 * std::countr_zero(lanes);
      const uint32_t v[3] = {named[0] - base_, named[1] - base_, named[2] - base_};
      cut.add(v, unsigned{outcodes_[v[0]]} | outcodes_[v[1]] | outcodes_[v[2]], provoking);
    }
  }

  void take_filtered(const FilteredTriangles& found, const uint32_t* corners, uint8_t provoking,
                     CutFaces* cut) {
    const uint32_t taken = found.kept | found.special;
    segment_.culled += found.dropped;
    for (uint32_t todo = taken; todo != 0; todo &= todo - 1) {
      const auto lane = uint32_t(std::countr_zero(todo));
      const uint32_t* v = corners + 3 * lane;
      if (found.special >> lane & 1)
        bin_pieces(cut->next());
      else
        bin_filtered(found, lane, v, provoking);
    }
  }

  void bin_filtered(const FilteredTriangles& found, uint32_t lane, const uint32_t* v, uint8_t provoking) {
    const bool back = (found.clockwise >> lane & 1) == facing_.front_is_ccw;
    const uint32_t primitive =
        append({{v[0] - base_, v[1] - base_, v[2] - base_}, PrimitiveKind::triangle, false, back, provoking});
    if (found.in_one_tile >> lane & 1) return push_to_bin(segment_, size_t(found.tile[lane]), primitive);
    const TileBox tiles{found.tile_x0[lane], found.tile_y0[lane], found.tile_x1[lane], found.tile_y1[lane]};
    const int32_t x[3] = {found.x[0][lane], found.x[1][lane], found.x[2][lane]};
    const int32_t y[3] = {found.y[0][lane], found.y[1][lane], found.y[2][lane]};
    bin_triangle(segment_, tiles, x, y, primitive);
  }

  Rect triangle_box(int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t x2, int32_t y2) const {
    return pixel_box(std::min(std::min(x0, x1), x2), std::min(std::min(y0, y1), y2),
                     std::max(std::max(x0, x1), x2), std::max(std::max(y0, y1), y2), bounds_);
  }

  void bin_pieces(const CutFaces::Pieces& pieces) {
    for (uint32_t i = pieces.first; i < pieces.first + pieces.count; ++i) {
      const CutTriangle& cut = segment_.cut_triangles[i];
      const Rect box = triangle_box(cut.x[0], cut.y[0], cut.x[1], cut.y[1], cut.x[2], cut.y[2]);
      if (box.empty()) continue;
      const uint32_t primitive = append({{i, 0, cut.source}, PrimitiveKind::triangle, true, pieces.back, 0});
      bin_triangle(segment_, tile_box(box), cut.x, cut.y, primitive);
    }
  }

  // Pixels a line of width 1 can reach: those its box touches, and one more for the diamonds beside it.
  Rect line_box(const int32_t x[2], const int32_t y[2]) const {
    return pixel_box(std::min(x[0], x[1]) - kSubpixelScale, std::min(y[0], y[1]) - kSubpixelScale,
                     std::max(x[0], x[1]) + kSubpixelScale, std::max(y[0], y[1]) + kSubpixelScale, bounds_);
  }

  void line(uint32_t from, uint32_t to) {
    const unsigned o0 = outcodes_[from], o1 = outcodes_[to];
    if ((o0 & o1) != 0 || ((o0 | o1) & kOutNotFinite)) return;
    if ((o0 | o1) & kOutCutMask) return cut_line(from, to, o0 | o1);
    const int32_t x[2] = {head(from).x, head(to).x}, y[2] = {head(from).y, head(to).y};
    const Rect box = line_box(x, y);
    if (box.empty() || (x[0] == x[1] && y[0] == y[1])) return;
    bin_line(tile_box(box), {{from, to, to}, PrimitiveKind::line, false, false, 1});
  }

  void cut_line(uint32_t from, uint32_t to, unsigned any) {
    ++segment_.clipped;
    const uint32_t v[2] = {from, to};
    CutTriangle cut;
    PlaneSource planes;
    if (!clipper().clip_line(v, any, cut, planes)) return;
    const Rect box = line_box(cut.x, cut.y);
    if (box.empty()) return;
    cut.source = 0;
    const auto index = uint32_t(segment_.cut_triangles.size());
    segment_.cut_triangles.push_back(cut);
    settle_pieces(draw_, PrimitiveKind::line, index, &planes, segment_);
    const uint32_t settled = segment_.cut_triangles[index].source;
    bin_line(tile_box(box), {{index, 0, settled}, PrimitiveKind::line, true, false, 0});
  }

  // A line that is no packet, where others may be.
  void bin_line(const TileBox& tiles, const PrimitiveRef& ref) {
    if (draw_.runs_lines) {
      segment_.refers_to_vertices = true;
      for (int ty = tiles.y0; ty <= tiles.y1; ++ty)
        for (int tx = tiles.x0; tx <= tiles.x1; ++tx) segment_.packets.close(tile_at(tx, ty));
    }
    bin_box(segment_, tiles, append(ref));
  }

  struct LineVertices {
    uint32_t from, to;
  };
  LineVertices line_vertices(Primitive mode, uint32_t k) const {
    if (mode == Primitive::lines) return {vertex(2 * k), vertex(2 * k + 1)};
    return {vertex(k), vertex(k + 1 < index_count_ ? k + 1 : 0)};
  }

  // Lines set up here, once for all tiles, as far as they are not cut.
  void run_lines(Primitive mode, uint32_t first, uint32_t count) {
    segment_.refers_to_vertices = false;
    const size_t largest =
        line_packet_bytes(1 + draw_.vertices.layout.attribute_count, draw_.program->reads_depth);
    constexpr size_t kInPiece = 32;
    segment_.packets.start_draw(segment_.bins.size(), largest, kInPiece);
    if (draw_.given_vertices != nullptr)
      run_given_lines(first, count);
    else
      run_shaded_lines(mode, first, count);
    segment_.packet_bytes += segment_.packets.finish_draw();
  }

  struct WaitingLines {
    LineGroup group;
    uint32_t ends[2 * kSetupLanes];
    int count = 0;
  };

  void run_shaded_lines(Primitive mode, uint32_t first, uint32_t count) {
    const SetUpLinesFunction make_group = set_up_lines();
    WaitingLines lines;
    const auto set_up = [&] {
      if (lines.count == 0) return;
      make_group(draw_, lines.ends, lines.count, lines.group);
      bin_packets(lines.group, lines.count,
                  [&](int lane) { line(lines.ends[2 * lane], lines.ends[2 * lane + 1]); });
      lines.count = 0;
    };
    for (uint32_t k = first; k < first + count; ++k) {
      const LineVertices v = line_vertices(mode, k);
      const unsigned o0 = outcodes_[v.from], o1 = outcodes_[v.to];
      if (((o0 & o1) | ((o0 | o1) & (kOutNotFinite | kOutCutMask))) != 0) [[unlikely]] {
        set_up();
        line(v.from, v.to);
        continue;
      }
      lines.ends[2 * lines.count] = v.from, lines.ends[2 * lines.count + 1] = v.to;
      if (++lines.count == kSetupLanes) set_up();
    }
    set_up();
  }

  // Separate lines straight from the application's memory, as far as they are not cut.
  void run_given_lines(uint32_t first, uint32_t count) {
    const LineEndShader shader(*draw_.state, *draw_.given_vertices, draw_.vertices.layout);
    const SetUpLineColumnsFunction make_group = set_up_line_columns();
    EndColumns ends;
    LineGroup group;
    for (uint32_t done = 0; done < count; done += EndColumns::kMost) {
      const uint32_t lines = std::min(count - done, EndColumns::kMost);
      shader.shade(2 * (first + done), lines, ends);
      for (uint32_t at = 0; at < lines; at += kSetupLanes) {
        const uint32_t line_at = first + done + at;
        const int n = int(std::min(lines - at, uint32_t{kSetupLanes}));
        if (!ends.all_inside && any_is_special(ends, at, n)) [[unlikely]] {
          shade_lines(line_at, uint32_t(n));
          run_shaded_lines(Primitive::lines, line_at, uint32_t(n));
          continue;
        }
        make_group(draw_, ends, at, n, group);
        bin_packets(group, n, [&](int lane) {
          shade_lines(line_at, uint32_t(n));
          line(2 * (line_at + uint32_t(lane)), 2 * (line_at + uint32_t(lane)) + 1);
        });
      }
    }
  }

  // Of lines from the `first` on: whether any is cut, or not to be seen.
  static bool any_is_special(const EndColumns& ends, uint32_t first, int count) {
    uint64_t special = 0;
    for (uint32_t i = first; i < first + uint32_t(count); ++i) {
      const uint64_t o0 = ends.end[0].outcode[i], o1 = ends.end[1].outcode[i];
      special |= (o0 & o1) | ((o0 | o1) & (kOutNotFinite | kOutCutMask));
    }
    return special != 0;
  }

  void shade_lines(uint32_t first, uint32_t count) {
    shade_vertices(*draw_.state, *draw_.given_vertices, 2 * first, 2 * count, *draw_.unshaded);
  }

  // double_line(lane): draws a line whose planes have to be double.
  template <class DoubleLine>
  void bin_packets(const LineGroup& group, int count, DoubleLine double_line) {
    if (!group.has_special(count)) {
      for (uint32_t todo = group.parts_drawn(count); todo != 0; todo &= todo - 1)
        bin_part(group, std::countr_zero(todo));
      return;
    }
    for (int lane = 0; lane < count; ++lane) {
      if (!group.is_drawn(lane)) continue;
      if (group.needs_double(lane)) {
        double_line(lane);
        continue;
      }
      if (group.whole[lane] != 0) {
        bin_whole(group, lane);
        continue;
      }
      const uint32_t parts = group.parts_drawn(count) & LineGroup::parts_of(lane);
      for (uint32_t todo = parts; todo != 0; todo &= todo - 1) bin_part(group, std::countr_zero(todo));
    }
  }

  void bin_part(const LineGroup& group, int place) {
    const int lane = place / LineGroup::kPlaces;
    const LineGroup::Part& part = group.parts[place % LineGroup::kPlaces];
    PacketBin& bin = line_bin(tile_at(part.x[lane], part.y[lane]));
    take_packet(bin, group.write(lane, part, bin.next));
  }

  void bin_whole(const LineGroup& group, int lane) {
    for (int ty = group.tile_y0[lane]; ty <= group.tile_y1[lane]; ++ty)
      for (int tx = group.tile_x0[lane]; tx <= group.tile_x1[lane]; ++tx) {
        const int x = tx * kTileSize, y = ty * kTileSize;
        PacketBin& bin = line_bin(tile_at(tx, ty));
        take_packet(bin, group.write_within(lane, intersect(bounds_, {x, y, x + kTileSize, y + kTileSize}),
                                            bin.next));
      }
  }

  // With room for a packet.
  PacketBin& line_bin(uint32_t tile) {
    PacketBin& bin = segment_.packets.bins()[tile];
    if (size_t(bin.limit - bin.next) < segment_.packets.largest()) open_run(tile, PrimitiveKind::line_run);
    return bin;
  }
  static void take_packet(PacketBin& bin, std::byte* end) {
    bin.next = end;
    // For the next one: many others come between.
    __builtin_prefetch(end, 1);
    __builtin_prefetch(end + 64, 1);
  }

  uint32_t tile_at(int tx, int ty) const { return uint32_t(ty * segment_.tiles_x + tx); }

  bool is_point_seen(uint32_t v, int& px, int& py) const {
    px = head(v).x >> kSubpixelBits, py = head(v).y >> kSubpixelBits;
    return outcodes_[v] == 0 && px >= bounds_.x0 && px < bounds_.x1 && py >= bounds_.y0 && py < bounds_.y1;
  }

  // A tile's points follow each other in memory, whatever came between.
  void run_points(uint32_t first, uint32_t count) {
    // Of many points a tile's lie in one piece, more often than not.
    constexpr size_t kLeastPiece = 768;  // bytes
    const size_t bytes = point_bytes(point_kind(*draw_.program)), tiles = segment_.bins.size();
    const size_t share = size_t{count} / tiles;
    segment_.packets.start_draw(tiles, bytes, std::max(kLeastPiece / bytes, share + share / 8));
    if (draw_.given_vertices != nullptr)
      place_points(*draw_.state, *draw_.given_vertices, draw_.vertices.layout, point_job(), first, count);
    else
      run_shaded_points(first, count);
    segment_.packet_bytes += segment_.packets.finish_draw();
  }

  PointJob point_job() {
    const auto open = [](void* assembler, uint32_t tile) {
      static_cast<Assembler*>(assembler)->open_run(tile, PrimitiveKind::point_run);
    };
    const double depth_steps = draw_.program->reads_depth ? double(kDepthMax) : 0;
    return {bounds_,          segment_.tiles_x,        depth_steps, point_kind(*draw_.program),
            constant_pixel(), segment_.packets.bins(), open,        this};
  }

  uint32_t constant_pixel() const {
    const float* color = draw_.program->params.constant_color;  // 0..255
    uint32_t pixel = 0;
    for (int k = 0; k < 4; ++k) pixel |= uint32_t(color[k] + 0.5f) << (8 * k);
    return pixel;
  }

  void run_shaded_points(uint32_t first, uint32_t count) {
    switch (point_kind(*draw_.program)) {
      case PointKind::colored:
        return run_shaded_points<PointPacket>(first, count);
      case PointKind::pixel:
        return run_shaded_points<PixelPoint>(first, count);
      case PointKind::tested_pixel:
        return run_shaded_points<TestedPixelPoint>(first, count);
    }
  }

  template <class Packet>
  void run_shaded_points(uint32_t first, uint32_t count) {
    const uint32_t constant = constant_pixel();
    PacketBin* bins = segment_.packets.bins();
    for (uint32_t k = first; k < first + count; ++k) {
      const uint32_t v = vertex(k);
      int px, py;
      if (!is_point_seen(v, px, py)) continue;
      const uint32_t tile = tile_at(px / kTileSize, py / kTileSize);
      PacketBin& bin = bins[tile];
      if (bin.next == bin.limit) open_run(tile, PrimitiveKind::point_run);
      auto& point = *reinterpret_cast<Packet*>(bin.next);
      bin.next += sizeof point;
      point.offset = tile_offset(px, py);
      if constexpr (!std::is_same_v<Packet, PixelPoint>)
        point.depth = int32_t(head(v).z * double(kDepthMax) + 0.5);
      const int color = draw_.vertices.layout.color;
      const float* of_vertex = reinterpret_cast<const float*>(&head(v) + 1) + color;
      if constexpr (std::is_same_v<Packet, PointPacket>) {
        if (color >= 0) std::memcpy(point.color, of_vertex, sizeof point.color);
      } else {
        point.pixel = color >= 0 ? rounded_pixel(of_vertex) : constant;
      }
    }
  }

  // As the fragment's stages make it of a colour in [0, 1].
  static uint32_t rounded_pixel(const float* color) {
    uint32_t pixel = 0;
    for (int k = 0; k < 4; ++k) pixel |= uint32_t(color[k] * 255.0f + 0.5f) << (8 * k);
    return pixel;
  }

  void open_run(uint32_t tile, PrimitiveKind kind) {
    const uint32_t run = segment_.packets.open(tile);
    push_to_bin(segment_, tile, append({{run, 0, 0}, kind, false, false, 0}));
  }

  const DrawRecord& draw_;
  Segment& segment_;
  const uint32_t* indices_;
  uint32_t index_count_;
  const std::byte* records_;
  size_t stride_;
  const uint16_t* outcodes_;
  Rect bounds_;
  FacingRule facing_;
  uint32_t base_;  // the name of vertex 0
  TriangleFilter filter_;
  std::optional<Clipper> clipper_;  // once something is cut
};

// Idempotent, so that a draw may come in several ranges.
void start_draw(const DrawRecord& draw, Segment& segment) {
  if (!segment.draws.empty() && segment.draws.back().draw == &draw) return;
  segment.draws.push_back({uint32_t(segment.primitives.size()), &draw});
}

}  // namespace

void assemble(const DrawRecord& draw, Primitive mode, const uint32_t* indices, uint32_t index_count,
              uint32_t first, uint32_t count, Segment& segment) {
  start_draw(draw, segment);
  if (draw.shape.general) return assemble_shapes(draw, mode, indices, index_count, first, count, segment);
  if (draw.bounds.empty()) return;
  Assembler assembler(draw, indices, index_count, segment);
  assemble_by_mode(assembler, mode, first, count);
}

}  // namespace halfspace::raster
