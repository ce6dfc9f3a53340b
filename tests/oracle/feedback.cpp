#include "tests/oracle/feedback.h"

#include "tests/oracle/clip.h"
#include "tests/oracle/outline.h"
#include "tests/oracle/primitives.h"
#include "tests/oracle/vertex.h"

namespace halfspace::oracle {
namespace {

class Feedback {
 public:
  Feedback(const raster::DrawPacket& packet, raster::FeedbackSink& sink)
      : packet_(packet), state_(*packet.state), sink_(sink), volume_(state_, Positions::unsnapped) {}

  void give(const GivenPrimitive& given, bool first) {
    std::vector<Vertex> vertices;
    for (const uint32_t place : given.places) {
      const uint32_t index = packet_.indices ? packet_.indices[place] : place;
      vertices.push_back(shade_vertex(state_, packet_.batch, packet_.materials, index));
      if (!vertices.back().usable) return;
      if (!given.flagged) vertices.back().corner.edge = true;
    }
    if (vertices.size() == 1) {
      if (volume_.holds(vertices[0].corner)) sink_.point(reported(vertices[0].corner));
    } else if (vertices.size() == 2) {
      Corner ends[2] = {colored(vertices[0], vertices[1], false), colored(vertices[1], vertices[1], false)};
      const bool restarts = given.restarts && !(first && packet_.continues);
      if (!volume_.rejects(ends, 2) && volume_.cut(ends, true))
        sink_.line(reported(ends[0]), reported(ends[1]), restarts);
    } else {
      give_polygon(vertices, vertices[given.provoking]);
    }
  }

 private:
  Corner colored(const Vertex& v, const Vertex& provoking, bool back) const {
    Corner c = v.corner;
    const Vertex& from = state_.raster.flat_shading ? provoking : v;
    for (size_t k = 0; k < 4; ++k) c.value[kRed + k] = back ? from.back[k] : from.corner.value[kRed + k];
    return c;
  }

  Polygon cut(const std::vector<Vertex>& vertices, const Vertex& provoking, bool back) const {
    Polygon polygon;
    for (const Vertex& v : vertices) polygon.push_back(colored(v, provoking, back));
    return volume_.cut_whole(polygon);
  }

  // Equation 2.6 says which side is seen; that side's polygon mode what is reported.
  void give_polygon(const std::vector<Vertex>& vertices, const Vertex& provoking) {
    Outline<Wide> outline;
    for (const Corner& c : cut(vertices, provoking, false)) outline.push_back(place_of(c, state_.viewport));
    if (outline.empty()) return;
    const bool back = (twice_area(outline) > 0) != state_.raster.front_is_ccw;
    if (back ? state_.raster.cull_back : state_.raster.cull_front) return;
    const Polygon left = cut(vertices, provoking, back);
    const raster::PolygonMode mode = back ? state_.polygon.back : state_.polygon.front;
    std::vector<raster::FeedbackVertex> all;
    for (const Corner& c : left) all.push_back(reported(c));
    if (mode == raster::PolygonMode::fill) return sink_.polygon(all);
    bool restarts = true;
    for (size_t i = 0; i < left.size(); ++i) {
      if (!left[i].edge) continue;
      if (mode == raster::PolygonMode::point)
        sink_.point(all[i]);
      else
        sink_.line(all[i], all[(i + 1) % all.size()], restarts);
      restarts = false;
    }
  }

  raster::FeedbackVertex reported(const Corner& c) const {
    const auto number = [](Wide v) { return static_cast<double>(v); };
    const auto value = [&](size_t place) { return number(c.value[place]); };
    const raster::Viewport& v = state_.viewport;
    const Place<Wide> at = place_of(c, v);
    const Wide near = wide(v.depth_near), far = wide(v.depth_far);
    const Wide z = (far - near) / 2 * (c.z / c.w) + (near + far) / 2;
    const auto color = [&](size_t k) { return static_cast<float>(c.value[kRed + k]); };
    return {number(at.x / 256),
            number(at.y / 256),
            number(near < far ? held(z, near, far) : held(z, far, near)),
            number(c.w),
            {color(0), color(1), color(2), color(3)},
            value(kCoordS),
            value(kCoordT),
            value(kCoordR),
            value(kCoordQ)};
  }

  const raster::DrawPacket& packet_;
  const raster::DrawState& state_;
  raster::FeedbackSink& sink_;
  const ClipVolume volume_;
};

}  // namespace

void feed_back(const raster::DrawPacket& packet, raster::FeedbackSink& sink) {
  Feedback feedback(packet, sink);
  bool first = true;
  for (const GivenPrimitive& given : primitives_of(packet.primitive, packet.index_count)) {
    feedback.give(given, first);
    first = false;
  }
}

}  // namespace halfspace::oracle
