#include "raster/primitive/shape_assembly.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "raster/primitive/clip.h"
#include "raster/primitive/patterns.h"
#include "raster/primitive/shape_clip.h"
#include "raster/primitive/window_box.h"
#include "raster/tile/coverage.h"
#include "raster/tile/settled_planes.h"

namespace halfspace::raster {
namespace {

// What points, lines and triangles inherit from the polygon they are made of.
struct Face {
  uint32_t provoking;  // vertex
  bool back;
  double offset;  // added to depth, which lies in [0, 1]
};

class ShapeAssembler {
 public:
  ShapeAssembler(const DrawRecord& draw, const uint32_t* indices, uint32_t index_count, Segment& segment)
      : draw_(draw),
        plan_(draw.shape),
        polygon_(draw.state->polygon),
        segment_(segment),
        indices_(indices),
        index_count_(index_count),
        window_(make_window_transform(draw.state->viewport)),
        clipper_(draw),
        stipple_(draw.stipple_start) {}
  ~ShapeAssembler() { segment_.stipple_end = stipple_; }
  ShapeAssembler(const ShapeAssembler&) = delete;
  ShapeAssembler& operator=(const ShapeAssembler&) = delete;

  template <class Pattern>
  void faces(uint32_t first, uint32_t count) {
    segment_.triangles_in += count;
    if (polygon_.front == PolygonMode::fill && polygon_.back == PolygonMode::fill) {
      for (uint32_t k = first; k < first + count; ++k) {
        const Corners at = Pattern::at(k);
        fill({vertex(at.v[0]), vertex(at.v[1]), vertex(at.v[2])}, Pattern::kProvoking, nullptr);
      }
      return;
    }
    for (uint32_t k = first; k < first + count; ++k) {
      if (Pattern::kTriangles == 0 ? k == 0 : k % Pattern::kTriangles == 0) polygon<Pattern>(k);
    }
  }

  void lines(Primitive mode, uint32_t first, uint32_t count) {
    for (uint32_t k = first; k < first + count; ++k) {
      const bool separate = mode == Primitive::lines;
      const uint32_t from = vertex(separate ? 2 * k : k);
      const uint32_t to = vertex(separate ? 2 * k + 1 : k + 1 < index_count_ ? k + 1 : 0);
      if (separate) stipple_ = 0;
      line(from, to, {to, false, 0});
    }
  }

  void points(uint32_t first, uint32_t count) {
    for (uint32_t k = first; k < first + count; ++k) point(vertex(k), {vertex(k), false, 0});
  }

 private:
  uint32_t vertex(uint32_t place) const { return indices_ ? indices_[place] - draw_.first_vertex : place; }
  const VertexHead& head(uint32_t v) const { return draw_.vertices.head(v); }
  unsigned codes(uint32_t v) const {
    const unsigned user = draw_.clip_codes ? draw_.clip_codes[v] : 0u;
    return draw_.vertices.outcodes[v] | user * user_outcode(0);
  }
  static constexpr unsigned kUserMask = user_outcode(kMaxClipPlanes) - user_outcode(0);
  static constexpr unsigned kCutMask = kOutCutMask | kUserMask;
  static constexpr unsigned kSides = kOutLeft | kOutRight | kOutBottom | kOutTop;
  static constexpr unsigned kViewMask = kSides | kOutNear | kOutFar | kOutW;

  uint32_t append(const PrimitiveRef& ref) {
    segment_.primitives.push_back(ref);
    return uint32_t(segment_.primitives.size() - 1);
  }

  bool is_culled(bool back) const {
    return back ? draw_.state->raster.cull_back : draw_.state->raster.cull_front;
  }
  bool is_back(int64_t area) const { return (area > 0) != draw_.state->raster.front_is_ccw; }

  // --- filled triangles

  struct Triple {
    uint32_t v[3];
  };

  // `face`: the polygon it belongs to, where that decides which way it faces; null: it decides alone.
  void fill(Triple t, uint8_t provoking, const Face* face) {
    const unsigned c0 = codes(t.v[0]), c1 = codes(t.v[1]), c2 = codes(t.v[2]), any = c0 | c1 | c2;
    if ((c0 & c1 & c2) != 0 || (any & kOutNotFinite)) {
      ++segment_.culled;
      return;
    }
    if (any & kCutMask) return fill_cut(t, any, provoking, face);
    int32_t x[3], y[3];
    for (int k = 0; k < 3; ++k) x[k] = head(t.v[k]).x, y[k] = head(t.v[k]).y;
    const int64_t area = triangle_area(x, y);
    const bool back = face ? face->back : is_back(area);
    if (area == 0 || (!face && is_culled(back))) {
      ++segment_.culled;
      return;
    }
    bin_filled({{t.v[0], t.v[1], t.v[2]}, kind(), false, back, provoking}, x, y);
  }

  void fill_cut(const Triple& t, unsigned any, uint8_t provoking, const Face* face) {
    ++segment_.clipped;
    Clipper::Polygon polygon;
    clipper_.clip_triangle(t.v, any, polygon);
    const bool back = face ? face->back : is_back(polygon.area);
    PlaneSource planes;
    if (polygon.count < 3 || (!face && is_culled(back)) || !clipper_.triangle_planes(t.v, polygon, planes)) {
      ++segment_.culled;
      return;
    }
    planes.provoking = t.v[provoking];
    const auto first = uint32_t(segment_.cut_triangles.size());
    for (int i = 0; i < polygon.triangle_count; ++i) {
      const CutTriangle cut = polygon.triangle_at(i, 0);
      if (triangle_area(cut.x, cut.y) != 0) segment_.cut_triangles.push_back(cut);
    }
    settle_pieces(draw_, kind(), first, &planes, segment_);
    for (uint32_t i = first; i < segment_.cut_triangles.size(); ++i) {
      const CutTriangle& cut = segment_.cut_triangles[i];
      bin_filled({{i, 0, cut.source}, kind(), true, back, 0}, cut.x, cut.y);
    }
  }

  PrimitiveKind kind() const {
    return plan_.smooth_polygons ? PrimitiveKind::smooth_triangle : PrimitiveKind::triangle;
  }

  void bin_filled(const PrimitiveRef& ref, const int32_t (&x)[3], const int32_t (&y)[3]) {
    // A smooth triangle reaches every pixel it touches, half a pixel beyond the last centre.
    const int32_t reach = plan_.smooth_polygons ? kSubpixelScale / 2 : 0;
    const Rect box =
        pixel_box(std::min({x[0], x[1], x[2]}) - reach, std::min({y[0], y[1], y[2]}) - reach,
                  std::max({x[0], x[1], x[2]}) + reach, std::max({y[0], y[1], y[2]}) + reach, draw_.bounds);
    if (box.empty()) {
      ++segment_.culled;
      return;
    }
    const uint32_t primitive = append(ref);
    if (plan_.smooth_polygons)
      bin_box(segment_, tile_box(box), primitive);
    else
      bin_triangle(segment_, tile_box(box), x, y, primitive);
  }

  // --- polygons as outlines and points

  template <class Pattern>
  void polygon(uint32_t k) {
    const uint32_t corners = Pattern::kTriangles == 0 ? index_count_ : Pattern::kTriangles + 2;
    corners_.clear();
    unsigned any = 0, all = ~0u;
    for (uint32_t i = 0; i < corners; ++i) {
      const uint32_t v = vertex(Pattern::face(k, i));
      corners_.push_back(v);
      any |= codes(v);
      all &= codes(v);
    }
    stipple_ = 0;  // spec 3.5.4: for each polygon
    Face face{corners_[Pattern::kProvokingCorner], false, 0};
    if (all != 0 || (any & kOutNotFinite) || !measure(any, face)) {
      ++segment_.culled;
      return;
    }
    const PolygonMode mode = face.back ? polygon_.back : polygon_.front;
    if (mode == PolygonMode::fill) {
      const uint32_t triangles = Pattern::kTriangles == 0 ? corners - 2 : Pattern::kTriangles;
      for (uint32_t j = 0; j < triangles; ++j) {
        const Corners at = Pattern::at(k + j);
        fill({vertex(at.v[0]), vertex(at.v[1]), vertex(at.v[2])}, Pattern::kProvoking, &face);
      }
      return;
    }
    outline(mode, any, Pattern::kFlagged ? draw_.edge_flags : nullptr, face);
  }

  // Which way the whole polygon faces, and its depth offset. False: it is culled, or nothing of it is left.
  bool measure(unsigned any, Face& face) const {
    const auto n = uint32_t(corners_.size());
    int64_t area = 0;
    double slope = 0;
    bool found = false;
    for (uint32_t i = 1; i + 1 < n; ++i) {
      const uint32_t v[3] = {corners_[0], corners_[i], corners_[i + 1]};
      double here = 0;
      const int64_t part = any & kOutCutMask ? cut_area(v, any, here) : whole_area(v, here);
      area += part;
      if (part != 0 && !found) slope = here;
      found = found || part != 0;
    }
    if ((any & kOutCutMask) && !found) return false;
    face.back = is_back(area);
    if (is_culled(face.back)) return false;
    if (is_offset(polygon_, face.back ? polygon_.back : polygon_.front)) {
      constexpr double kSteps = 16777215;
      face.offset = depth_offset(polygon_, slope * kSteps) / kSteps;
    }
    return true;
  }

  // Twice the area of a triangle of the polygon, and the greater of the slopes of its depth, per pixel.
  int64_t cut_area(const uint32_t (&v)[3], unsigned any, double& slope) const {
    Clipper::Polygon cut;
    clipper_.clip_triangle(v, any & kOutCutMask, cut);
    PlaneSource planes;
    if (cut.count < 3 || !clipper_.triangle_planes(v, cut, planes)) return 0;
    slope = std::max(std::abs(planes.planes[0].dfdx), std::abs(planes.planes[0].dfdy));
    return cut.area;
  }

  int64_t whole_area(const uint32_t (&v)[3], double& slope) const {
    const VertexHead &a = head(v[0]), &b = head(v[1]), &c = head(v[2]);
    const int64_t x1 = b.x - a.x, y1 = b.y - a.y, x2 = c.x - a.x, y2 = c.y - a.y, area = x1 * y2 - x2 * y1;
    if (area == 0) return 0;
    const double z1 = b.z - a.z, z2 = c.z - a.z, scale = kSubpixelScale / double(area);
    slope = std::max(std::abs((z1 * double(y2) - z2 * double(y1)) * scale),
                     std::abs((z2 * double(x1) - z1 * double(x2)) * scale));
    return area;
  }

  void outline(PolygonMode mode, unsigned any, const uint8_t* edge_flags, const Face& face) {
    // A line is cut when it is drawn; for points it matters where an edge enters the view volume.
    const unsigned cuts = mode == PolygonMode::line ? kUserMask : kUserMask | kViewMask;
    if (any & cuts) return cut_outline(mode, any, edge_flags, face);
    const size_t n = corners_.size();
    for (size_t i = 0; i < n; ++i) {
      const uint32_t v = corners_[i];
      if (edge_flags && !edge_flags[v]) continue;
      if (mode == PolygonMode::line)
        line(v, corners_[i + 1 < n ? i + 1 : 0], face);
      else
        point(v, face);
    }
  }

  void cut_outline(PolygonMode mode, unsigned any, const uint8_t* edge_flags, const Face& face) {
    cut_.clear();
    for (uint32_t v : corners_) {
      cut_.push_back(shape_vertex(draw_, v, face.back));
      cut_.back().edge = !edge_flags || edge_flags[v];
    }
    cut_by_user_planes(any, cut_, cut_scratch_);
    if (mode == PolygonMode::point) cut_by_view_volume(window_, any, cut_, cut_scratch_);
    const size_t n = cut_.size();
    for (size_t i = 0; i < n; ++i) {
      if (!cut_[i].edge) continue;
      // A vertex made by a cut is none of the outcodes' business: all planes are asked.
      if (mode == PolygonMode::line)
        line({cut_[i], cut_[i + 1 < n ? i + 1 : 0]}, kOutCutMask | kSides, face);
      else
        point(cut_[i], face);
    }
  }

  // --- lines

  struct Ends {
    ShapeVertex end[2];
  };

  void line(uint32_t from, uint32_t to, const Face& face) {
    const unsigned c0 = codes(from), c1 = codes(to);
    if ((c0 & c1) != 0 || ((c0 | c1) & kOutNotFinite)) return;
    if (!plan_.plain_lines() || face.offset != 0 || ((c0 | c1) & kCutMask))
      return line({shape_vertex(draw_, from, face.back), shape_vertex(draw_, to, face.back)}, c0 | c1, face);
    const VertexHead &a = head(from), &b = head(to);
    const Rect box = line_box({a.x, b.x}, {a.y, b.y});
    if (box.empty() || (a.x == b.x && a.y == b.y)) return;
    bin_box(segment_, tile_box(box),
            append({{from, to, face.provoking}, PrimitiveKind::line, false, face.back, 2}));
  }

  void line(Ends line, unsigned any, const Face& face) {
    if (any & (kCutMask | kSides)) {
      if (any & kCutMask) ++segment_.clipped;
      if (!cut_shape_line(window_, any, plan_.smooth_lines, line.end)) return;
    }
    CutTriangle cut;
    for (int k = 0; k < 2; ++k) place_vertex(draw_, window_, line.end[k], cut.x[k], cut.y[k]);
    cut.x[2] = cut.x[1], cut.y[2] = cut.y[1];
    if (cut.x[0] == cut.x[1] && cut.y[0] == cut.y[1]) return;
    const uint32_t start = stipple_;
    if (plan_.stippled_lines) stipple_ = stipple_after(plan_, draw_.state->line, start, cut);
    const Rect box = line_box({cut.x[0], cut.x[1]}, {cut.y[0], cut.y[1]});
    PlaneSource planes;
    const bool wide = plan_.line_width > 1 && !plan_.smooth_lines;
    if (box.empty() || !line_planes(draw_, window_, line.end, wide, face.offset, cut, planes)) return;
    planes.provoking = face.provoking;
    append_cut(cut, planes, PrimitiveKind::line, start, face.back, box);
  }

  void append_cut(CutTriangle& cut, const PlaneSource& planes, PrimitiveKind kind, uint32_t stipple,
                  bool back, const Rect& box) {
    cut.source = 0;
    const auto index = uint32_t(segment_.cut_triangles.size());
    segment_.cut_triangles.push_back(cut);
    settle_pieces(draw_, kind, index, &planes, segment_);
    const uint32_t settled = segment_.cut_triangles[index].source;
    bin_box(segment_, tile_box(box), append({{index, stipple, settled}, kind, true, back, 0}));
  }

  // Pixels a line can reach: those its box touches, half its width more, and one for the diamonds beside it.
  Rect line_box(const int32_t (&x)[2], const int32_t (&y)[2]) const {
    const bool narrow = plan_.line_width == 1 && !plan_.smooth_lines;
    const double width = plan_.smooth_lines ? plan_.smooth_line_width : plan_.line_width - 1;
    const int32_t reach = kSubpixelScale + int32_t(width * (kSubpixelScale / 2));
    return pixel_box(std::min(x[0], x[1]) - reach, std::min(y[0], y[1]) - reach, std::max(x[0], x[1]) + reach,
                     std::max(y[0], y[1]) + reach, narrow ? draw_.bounds : draw_.window);
  }

  // --- points

  void point(uint32_t v, const Face& face) {
    if (codes(v) != 0) return;
    if (face.offset != 0) return point(shape_vertex(draw_, v, face.back), face);
    const Rect box = point_box(head(v).x, head(v).y);
    if (box.empty()) return;
    bin_box(segment_, tile_box(box),
            append({{v, v, face.provoking}, PrimitiveKind::point, false, face.back, 2}));
  }

  // One of a cut polygon's, which is inside but for rounding.
  void point(const ShapeVertex& vertex, const Face& face) {
    if (!(vertex.clip.w > 0)) return;
    CutTriangle cut{};
    place_vertex(draw_, window_, vertex, cut.x[0], cut.y[0]);
    cut.x[2] = cut.x[1] = cut.x[0], cut.y[2] = cut.y[1] = cut.y[0];
    const Rect box = point_box(cut.x[0], cut.y[0]);
    PlaneSource planes;
    if (box.empty() || !point_planes(draw_, window_, vertex, face.offset, cut, planes)) return;
    planes.provoking = face.provoking;
    append_cut(cut, planes, PrimitiveKind::point, 0, face.back, box);
  }

  Rect point_box(int32_t x, int32_t y) const {
    if (!plan_.smooth_points) {
      const Rect square = point_square(x, y, plan_.point_size);
      return intersect(square, plan_.point_size == 1 ? draw_.bounds : draw_.window);
    }
    const int32_t reach = kSubpixelScale / 2 + int32_t(plan_.smooth_point_size * (kSubpixelScale / 2));
    return pixel_box(x - reach, y - reach, x + reach, y + reach, draw_.window);
  }

  const DrawRecord& draw_;
  const ShapePlan& plan_;
  const PolygonState& polygon_;
  Segment& segment_;
  const uint32_t* indices_;
  uint32_t index_count_;
  WindowTransform window_;
  Clipper clipper_;
  uint32_t stipple_;
  std::vector<uint32_t> corners_;               // of the polygon at hand
  std::vector<ShapeVertex> cut_, cut_scratch_;  // what user planes leave of it
};

}  // namespace

void assemble_shapes(const DrawRecord& draw, Primitive mode, const uint32_t* indices, uint32_t index_count,
                     uint32_t first, uint32_t count, Segment& segment) {
  ShapeAssembler assembler(draw, indices, index_count, segment);
  assemble_by_mode(assembler, mode, first, count);
}

void clip_distances(const DrawState& state, const VertexBatch& batch, double* distances, uint8_t* codes) {
  const ClipPlaneState& planes = state.clip_planes;
  const auto& m = state.eye_from_object;
  double object[kMaxClipPlanes][4] = {};  // the planes in object coordinates: row vector times the modelview
  for (size_t i = 0; i < kMaxClipPlanes; ++i) {
    const auto& p = planes.planes[i];
    for (size_t j = 0; j < 4; ++j)
      object[i][j] = ((p[0] * m[4 * j] + p[1] * m[4 * j + 1]) + p[2] * m[4 * j + 2]) + p[3] * m[4 * j + 3];
  }
  const AttributeStream& stream = batch.position;
  for (uint32_t v = 0; v < batch.count; ++v) {
    float at[4] = {0, 0, 0, 1};
    if (stream.data)
      std::memcpy(at, static_cast<const std::byte*>(stream.data) + v * stream.stride,
                  stream.size * sizeof(float));
    codes[v] = 0;
    for (size_t i = 0; i < kMaxClipPlanes; ++i) {
      double& d = distances[v * kMaxClipPlanes + i];
      d = 0;
      if (!(planes.enabled >> i & 1)) continue;
      const double* p = object[i];
      d = ((p[0] * double(at[0]) + p[1] * double(at[1])) + p[2] * double(at[2])) + p[3] * double(at[3]);
      if (!std::isfinite(d)) d = -1;  // overflow: such a vertex lies nowhere
      if (d < 0) codes[v] = uint8_t(codes[v] | 1u << i);
    }
  }
}

uint32_t stipple_after(const ShapePlan& plan, const LineState& line, uint32_t start,
                       const CutTriangle& ends) {
  const auto period = uint32_t(16 * line.repeat);
  if (plan.smooth_lines) {
    const double dx = ends.x[1] - ends.x[0], dy = ends.y[1] - ends.y[0];
    const auto length = uint64_t(std::sqrt(dx * dx + dy * dy) + 0.5);
    return uint32_t((start + length) % (uint64_t{period} * kSubpixelScale));
  }
  const LineRun run = line_run({ends.x[0], ends.y[0], ends.x[1], ends.y[1]}, plan.line_width);
  return (start + run.count) % period;
}

}  // namespace halfspace::raster
