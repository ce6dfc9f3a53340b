// Clipping in homogeneous coordinates (spec 2.12).
#pragma once

#include <vector>

#include "tests/oracle/corner.h"

namespace halfspace::oracle {

// Where coverage is taken from. Snapped: corners are rounded to 1/256 px, the rule of the house. Unsnapped:
// as they are, as if there were no grid.
enum class Positions : uint8_t { snapped, unsnapped };

using Polygon = std::vector<Corner>;

// The view volume is cut at near and far and at the user's planes. Its sides need no cut: no fragment outside
// the viewport is made of what crosses them. Only where snapped coordinates would grow without end are they
// held to a band around the window; cutting there snaps, so a picture from snapped corners has to do it at
// the same place.
class ClipVolume {
 public:
  ClipVolume(const raster::DrawState& state, Positions positions) : state_(state), positions_(positions) {}

  // All corners lie beyond one side of the view volume, or beyond one user plane.
  bool rejects(const Corner* corners, size_t count) const;
  // A convex polygon, cut; empty when nothing is left. *was_cut: some plane had to. `by_user`: the user's
  // planes cut, too.
  Polygon cut(const Polygon& polygon, bool* was_cut, bool by_user = true) const;
  // A polygon whose edges are to be drawn, cut by the user's planes, and `at_view_volume`. What is left of an
  // edge keeps its flag. The edge that a user plane makes is drawn; one along the view volume's boundary is
  // not (the house's reading of spec 2.12: it would frame the picture).
  Polygon cut_outline(const Polygon& polygon, bool at_view_volume) const;
  // A line; false: nothing is left. `sides`: at the four sides of the view volume, too.
  bool cut(Corner (&ends)[2], bool sides) const;
  // A polygon as feedback reports it: cut at all six sides and by the user's planes.
  Polygon cut_whole(const Polygon& polygon) const;
  // A point is in or out.
  bool holds(const Corner& corner) const;

  static constexpr int kFrustum = 6, kBand = 4;
  // Signed distances, >= 0 inside: [0, 6) near far left right bottom top, [6, 7) w > 0, [7, 11) the band,
  // [11, 17) the user's planes.
  static constexpr int kPlaneW = kFrustum, kFirstBand = kPlaneW + 1, kFirstUser = kFirstBand + kBand,
                       kPlanes = kFirstUser + raster::kMaxClipPlanes;
  Wide distance(const Corner& corner, int plane) const;

 private:
  bool applies(int plane) const;

  const raster::DrawState& state_;
  Positions positions_;
};

// The point of the edge on the plane, by the distances d_in >= 0 > d_out of its ends.
Corner crossing(const Corner& in, Wide d_in, const Corner& out, Wide d_out);

}  // namespace halfspace::oracle
