#include "tests/oracle/assembly.h"

#include <algorithm>

#include "tests/oracle/area.h"
#include "tests/oracle/primitives.h"

namespace halfspace::oracle {
namespace {

using raster::PolygonMode;

constexpr Real kLeastCoverage = 1e-6L;  // less is rounding's work

template <class T>
T signed_area(const Polygon& polygon, const raster::Viewport& viewport) {
  Outline<T> outline;
  for (const Corner& c : polygon) {
    if constexpr (std::is_same_v<T, int64_t>)
      outline.push_back(snapped_place_of(c, viewport));
    else
      outline.push_back(place_of(c, viewport));
  }
  return twice_area(outline);
}

}  // namespace

Assembly::Assembly(Painter& painter, const raster::DrawPacket& packet, Positions positions,
                   Progress& progress)
    : painter_(painter),
      packet_(packet),
      state_(*packet.state),
      polygon_(state_.polygon),
      positions_(positions),
      volume_(state_, positions),
      progress_(progress),
      vertices_(packet.batch.count) {}

void Assembly::run() {
  if (!packet_.continues) progress_.stipple = 0;
  bool first = true;
  for (const GivenPrimitive& given : primitives_of(packet_.primitive, packet_.index_count)) {
    if (given.places.size() == 1)
      given_point(given);
    else if (given.places.size() == 2)
      given_line(given, first);
    else
      polygon(given.places, given.provoking, given.flagged);
    first = false;
  }
}

const Vertex& Assembly::vertex(uint32_t place) {
  const uint32_t index = packet_.indices ? packet_.indices[place] : place;
  if (!vertices_[index]) vertices_[index] = shade_vertex(state_, packet_.batch, packet_.materials, index);
  return *vertices_[index];
}

// The colour is that of the side that is seen (spec 2.14.1); with flat shading the provoking vertex's
// (spec 2.14.7).
Corner Assembly::corner(const Vertex& v, const Side& side) const {
  Corner c = v.corner;
  const Vertex& colored = state_.raster.flat_shading && side.provoking ? *side.provoking : v;
  for (size_t k = 0; k < 4; ++k)
    c.value[kRed + k] = side.back ? colored.back[k] : colored.corner.value[kRed + k];
  return c;
}

// Counts the primitive. False: it is not to be drawn, by a corner that is nowhere or by lying outside.
bool Assembly::start(std::span<const uint32_t> places) {
  bool usable = true, doubtful = false;
  std::vector<Corner> corners;
  for (const uint32_t place : places) {
    const Vertex& v = vertex(place);
    usable = usable && v.usable;
    doubtful = doubtful || v.doubtful;
    corners.push_back(v.corner);
  }
  painter_.start_primitive(++progress_.primitives, doubtful);
  return usable && !volume_.rejects(corners.data(), corners.size());
}

void Assembly::given_point(const GivenPrimitive& given) {
  const Vertex& v = vertex(given.places[0]);
  if (start(given.places) && volume_.holds(v.corner)) point(corner(v, {}), {});
}

// The stipple starts anew for each separate line, and runs on along strips and loops (spec 3.4.2.2), also
// from draw to draw.
void Assembly::given_line(const GivenPrimitive& given, bool first) {
  if (given.restarts && !(first && packet_.continues)) progress_.stipple = 0;
  const Side side{false, 0, &vertex(given.places[given.provoking])};
  if (start(given.places))
    line(corner(vertex(given.places[0]), side), corner(vertex(given.places[1]), side), side);
}

// A polygon is drawn as the triangles of a fan around its provoking vertex (the house's choice: spec 3.5.1
// leaves it open). Where sides may be drawn differently the polygon as a whole decides which one is seen,
// else each triangle.
void Assembly::polygon(const Face& face, uint32_t provoking, bool flagged) {
  const bool visible = start(face);
  progress_.stipple = 0;  // spec 3.5.4: for each polygon
  if (!visible) return;
  std::optional<Side> side;
  if (polygon_.front != PolygonMode::fill || polygon_.back != PolygonMode::fill) {
    side = measure(face, provoking);
    if (!side) return;
    if (mode_of(side->back) != PolygonMode::fill) return outline(face, *side, flagged);
  }
  const auto n = static_cast<uint32_t>(face.size());
  const auto at = [&](uint32_t k) { return face[(provoking + k) % n]; };
  for (uint32_t k = 1; k + 1 < n; ++k)
    fill({at(0), at(k), at(k + 1)}, face[provoking], side ? &*side : nullptr);
}

// Equation 2.6: the sign of the area in the window says which side is seen. None: culled, or nothing is left.
std::optional<Assembly::Side> Assembly::measure(const Face& face, uint32_t provoking) {
  int64_t area = 0;
  std::optional<Surface> surface;
  for (size_t i = 1; i + 1 < face.size(); ++i) {
    const std::array<Corner, 3> c{vertex(face[0]).corner, vertex(face[i]).corner, vertex(face[i + 1]).corner};
    bool was_cut;
    const Polygon left = volume_.cut({c[0], c[1], c[2]}, &was_cut, false);
    const int64_t part = signed_area<int64_t>(left, state_.viewport);
    area += part;
    if (part != 0 && !surface) surface = Surface::of_triangle(c, state_.viewport);
  }
  Side side{(area > 0) != state_.raster.front_is_ccw, 0, &vertex(face[provoking])};
  if (is_culled(side.back)) return std::nullopt;
  if (surface) side.offset = offset_of(mode_of(side.back), *surface);
  return side;
}

// Spec 3.5.5: o = m * factor + r * units, r being one step of the depth buffer; held to twice the depth
// range.
Real Assembly::offset_of(PolygonMode mode, const Surface& surface) const {
  const bool on = mode == PolygonMode::fill   ? polygon_.offset_fill
                  : mode == PolygonMode::line ? polygon_.offset_line
                                              : polygon_.offset_point;
  if (!on) return 0;
  constexpr Real kMost = 33554432;
  const Real offset = surface.steepest_depth() * real(polygon_.offset_factor) + real(polygon_.offset_units);
  return offset == offset ? held(offset, -kMost, kMost) : 0;
}

void Assembly::fill(const std::array<uint32_t, 3>& places, uint32_t provoking, const Side* given) {
  std::array<Corner, 3> c;
  for (size_t i = 0; i < 3; ++i) c[i] = vertex(places[i]).corner;
  if (volume_.rejects(c.data(), 3)) return;
  bool was_cut;
  const Polygon left = volume_.cut({c[0], c[1], c[2]}, &was_cut);
  if (left.empty()) return;
  const bool snapped = positions_ == Positions::snapped;
  const int64_t snapped_area = snapped ? signed_area<int64_t>(left, state_.viewport) : 0;
  const Wide area = snapped ? wide(snapped_area) : signed_area<Wide>(left, state_.viewport);
  if (area == 0) return;
  Side side;
  if (given)
    side = *given;
  else
    side.back = (area > 0) != state_.raster.front_is_ccw;
  side.provoking = &vertex(provoking);
  if (is_culled(side.back)) return;
  for (size_t i = 0; i < 3; ++i) c[i] = corner(vertex(places[i]), side);
  std::array<Place<int64_t>, 3> at;
  bool leaves_grid = !snapped || was_cut;
  if (!leaves_grid) {
    for (size_t i = 0; i < 3; ++i) at[i] = snapped_place_of(c[i], state_.viewport);
    leaves_grid = may_leave_grid(c, state_.viewport, at);
  }
  std::optional<Surface> surface = Surface::of_triangle(c, state_.viewport, leaves_grid ? nullptr : &at);
  if (!surface) return;
  surface->add_depth(offset_of(PolygonMode::fill, *surface));
  fill_inside(left, *surface);
}

bool Assembly::stippled_away(int px, int py) const {
  return polygon_.stipple && (polygon_.pattern[static_cast<size_t>(py % 32)] >> (31 - px % 32) & 1) == 0;
}

void Assembly::fill_inside(const Polygon& left, const Surface& surface) {
  const auto paint = [&](int x, int y) {
    if (!stippled_away(x, y)) painter_.paint(x, y, surface);
  };
  Outline<Wide> exact;
  Outline<int64_t> snapped;
  for (const Corner& c : left) {
    exact.push_back(place_of(c, state_.viewport));
    snapped.push_back(snapped_place_of(c, state_.viewport));
  }
  if (!polygon_.smooth) {
    if (positions_ == Positions::snapped)
      for_pixels_inside(snapped, painter_.bounds(), paint);
    else
      for_pixels_inside(exact, painter_.bounds(), paint);
    return;
  }
  std::vector<Point> shape;
  for (const Place<int64_t>& p : snapped) shape.push_back({real(p.x) / 256, real(p.y) / 256});
  if (twice_area(snapped) < 0) std::reverse(shape.begin(), shape.end());
  const raster::Rect box = painter_.bounds();
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      const Real part = polygon_area_in_pixel(shape, x, y);
      if (part >= kLeastCoverage && !stippled_away(x, y)) painter_.paint(x, y, surface, part);
    }
  }
}

// Spec 3.5.4: the edges, or the vertices that start them, which are flagged as the polygon's boundary.
void Assembly::outline(const Face& face, const Side& side, bool flagged) {
  Polygon corners;
  for (const uint32_t place : face) {
    corners.push_back(corner(vertex(place), side));
    if (!flagged) corners.back().edge = true;
  }
  const bool lines = mode_of(side.back) == PolygonMode::line;  // each of them is cut when it is drawn
  const Polygon left = volume_.cut_outline(corners, !lines);
  for (size_t i = 0; i < left.size(); ++i) {
    if (!left[i].edge) continue;
    if (lines)
      line(left[i], left[(i + 1) % left.size()], side);
    else
      point(left[i], side);
  }
}

}  // namespace halfspace::oracle
