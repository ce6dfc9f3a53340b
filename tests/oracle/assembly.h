// From a draw to fragments: vertices to points, lines and polygons (spec 2.6), those clipped, culled and
// rasterised (spec 3.3 - 3.5).
#pragma once

#include <optional>
#include <span>

#include "tests/oracle/clip.h"
#include "tests/oracle/painter.h"
#include "tests/oracle/primitives.h"
#include "tests/oracle/vertex.h"

namespace halfspace::oracle {

// What goes on from draw to draw.
struct Progress {
  uint32_t primitives = 0;  // of the frame so far
  Real stipple =
      0;  // where the stipple of the last line stands: fragments, or pixels of a smooth line's length
};

class Assembly {
 public:
  Assembly(Painter& painter, const raster::DrawPacket& packet, Positions positions, Progress& progress);
  void run();

 private:
  using Face = std::vector<uint32_t>;  // places in the draw's list of vertices
  // What a polygon hands on to what it is drawn as.
  struct Side {
    bool back = false;
    Real offset = 0;  // of depth, steps
    const Vertex* provoking = nullptr;
  };

  const Vertex& vertex(uint32_t place);
  Corner corner(const Vertex& v, const Side& side) const;
  bool start(std::span<const uint32_t> places);

  void given_point(const GivenPrimitive& given);
  void given_line(const GivenPrimitive& given, bool first);
  void polygon(const Face& face, uint32_t provoking, bool flagged);
  std::optional<Side> measure(const Face& face, uint32_t provoking);
  void fill(const std::array<uint32_t, 3>& places, uint32_t provoking, const Side* side);
  void fill_inside(const Polygon& left, const Surface& surface);
  void outline(const Face& face, const Side& side, bool flagged);

  void line(Corner a, Corner b, const Side& side);
  void plain_line(const Place<int64_t> (&at)[2], const Surface& surface);
  void smooth_line(const Place<int64_t> (&at)[2], const Surface& surface);
  void point(const Corner& corner, const Side& side);

  raster::PolygonMode mode_of(bool back) const { return back ? polygon_.back : polygon_.front; }
  bool is_culled(bool back) const { return back ? state_.raster.cull_back : state_.raster.cull_front; }
  Real offset_of(raster::PolygonMode mode, const Surface& surface) const;
  bool stippled_away(int px, int py) const;

  Painter& painter_;
  const raster::DrawPacket& packet_;
  const raster::DrawState& state_;
  const raster::PolygonState& polygon_;
  const Positions positions_;
  const ClipVolume volume_;
  Progress& progress_;
  std::vector<std::optional<Vertex>> vertices_;  // shaded when first looked at
};

}  // namespace halfspace::oracle
