// Primitives for selection and feedback (spec 5.2, 5.3): whole, cut at the clip volume itself and never at
// the guard band, in double, and not snapped.
#include "raster/api/feedback.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "raster/api/device.h"
#include "raster/primitive/clip_planes.h"
#include "raster/vertex/vertex_stage.h"

namespace halfspace::raster {
namespace {

// What is interpolated where a primitive is cut: the clip coordinates, the distances to the user clip planes,
// and what only feedback looks at.
struct Vertex {
  ClipVertex clip;
  double user[kMaxClipPlanes];
  double front[4], back[4];  // colours
  double tex_coord[4];       // s t r q
  bool edge;                 // the edge that starts here is one of the primitive's own
};

constexpr int kFrustumPlanes = 6;

// >= 0: inside plane `i`, the frustum's first.
double plane_distance(const Vertex& v, int i) {
  const ClipVertex& c = v.clip;
  switch (i) {
    case 0:
      return c.w + c.z;
    case 1:
      return c.w - c.z;
    case 2:
      return c.w + c.x;
    case 3:
      return c.w - c.x;
    case 4:
      return c.w + c.y;
    case 5:
      return c.w - c.y;
    default:
      return v.user[i - kFrustumPlanes];
  }
}

void cross(const double* in, double d_in, const double* out, double d_out, int count, double* result) {
  for (int i = 0; i < count; ++i) result[i] = crossing(in[i], d_in, out[i], d_out);
}

Vertex crossing(const Vertex& in, double d_in, const Vertex& out, double d_out) {
  Vertex v;
  v.clip = crossing(in.clip, d_in, out.clip, d_out);
  cross(in.user, d_in, out.user, d_out, kMaxClipPlanes, v.user);
  cross(in.front, d_in, out.front, d_out, 4, v.front);
  cross(in.back, d_in, out.back, d_out, 4, v.back);
  cross(in.tex_coord, d_in, out.tex_coord, d_out, 4, v.tex_coord);
  v.edge = false;
  return v;
}

bool is_finite(const ClipVertex& c) {
  return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z) && std::isfinite(c.w);
}

class Feedback {
 public:
  Feedback(const DrawPacket& packet, FeedbackSink& sink)
      : packet_(packet),
        state_(*packet.state),
        sink_(sink),
        window_(make_window_transform(state_.viewport)),
        attributes_(sink.needs_attributes()) {
    shaded_.layout = VertexLayout{};
    shade();
  }

  void run() {
    switch (packet_.primitive) {
      case Primitive::points:
        for (uint32_t i = 0; i < packet_.index_count; ++i) point(vertex(i));
        return;
      case Primitive::lines:
      case Primitive::line_strip:
      case Primitive::line_loop:
        return lines();
      case Primitive::polygon:
        return whole_polygon();
      case Primitive::triangles:
        return groups(3, {0, 1, 2}, 3);
      case Primitive::quads:
        return groups(4, {0, 1, 2, 3}, 4);
      case Primitive::triangle_strip:
        return triangle_strip();
      case Primitive::triangle_fan:
        return triangle_fan();
      case Primitive::quad_strip:
        return groups(2, {0, 1, 3, 2}, 4);
    }
  }

 private:
  struct Order {
    uint32_t at[4];
  };

  void shade();
  void shade_attributes(uint32_t index, Vertex& out) const;
  Vertex vertex(uint32_t place) const;

  void lines();
  void whole_polygon();
  void triangle_strip();
  void triangle_fan();
  void groups(uint32_t step, Order order, uint32_t size);

  void point(const Vertex& v);
  void line(Vertex a, Vertex b, bool reset);
  void polygon(uint32_t provoking);
  void outline(bool back);
  bool cut_polygon(int plane);
  double signed_area() const;
  FeedbackVertex result(const Vertex& v, bool back) const;

  bool is_cut_by(int plane) const {
    return plane < kFrustumPlanes || (state_.clip_planes.enabled >> (plane - kFrustumPlanes) & 1);
  }
  bool is_inside(const Vertex& v) const {
    for (int i = 0; i < kFrustumPlanes + kMaxClipPlanes; ++i) {
      if (is_cut_by(i) && !(plane_distance(v, i) >= 0)) return false;
    }
    return v.clip.w > 0;
  }

  const DrawPacket& packet_;
  const DrawState& state_;
  FeedbackSink& sink_;
  const WindowTransform window_;
  const bool attributes_;
  ShadedVertices shaded_;
  std::vector<std::byte> records_;
  std::vector<Vertex> polygon_, scratch_;
  std::vector<FeedbackVertex> results_;
};

// Positions go through the vertex stage's own kernel, so that what is drawn and what is reported agree.
void Feedback::shade() {
  const uint32_t count = packet_.batch.count;
  shaded_.count = count;
  records_.resize(count * shaded_.layout.stride());
  shaded_.records = records_.data();
  shaded_.outcodes.resize(count);
  shaded_.clip = {packet_.batch.position, state_};
  shade_vertices(state_, packet_.batch, 0, count, shaded_);
}

void read_attribute(const AttributeStream& stream, uint32_t index, double (&v)[4]) {
  if (stream.data == nullptr) return;
  float f[4];
  std::memcpy(f, static_cast<const std::byte*>(stream.data) + index * stream.stride,
              stream.size * sizeof(float));
  for (int i = 0; i < stream.size; ++i) v[i] = double(f[i]);
}

double dot(const std::array<double, 4>& p, const double (&v)[4]) {
  return ((p[0] * v[0] + p[1] * v[1]) + p[2] * v[2]) + p[3] * v[3];
}

void transform(const std::array<double, 16>& m, const double (&v)[4], double (&out)[4]) {
  for (size_t r = 0; r < 4; ++r)
    out[r] = ((m[r] * v[0] + m[4 + r] * v[1]) + m[8 + r] * v[2]) + m[12 + r] * v[3];
}

void copy(const Color& color, double (&out)[4]) {
  out[0] = double(color.r), out[1] = double(color.g), out[2] = double(color.b), out[3] = double(color.a);
}

// One vertex at a time, and all that it has.
void Feedback::shade_attributes(uint32_t index, Vertex& out) const {
  VertexAttributes attributes;
  raster::shade_attributes(state_, part_of(packet_.batch, index, 1), packet_.materials, {&attributes, 1});
  copy(attributes.color, out.front);
  copy(attributes.back_color, out.back);
  for (int i = 0; i < 4; ++i) out.tex_coord[i] = double(attributes.tex_coord[i]);
}

Vertex Feedback::vertex(uint32_t place) const {
  const uint32_t index = packet_.indices ? packet_.indices[place] : place;
  Vertex v{};
  v.clip = shaded_.clip[index];
  v.edge = packet_.batch.edge_flag == nullptr || packet_.batch.edge_flag[index] != 0;
  if (state_.clip_planes.enabled != 0) {
    double object[4] = {0, 0, 0, 1}, eye[4];
    read_attribute(packet_.batch.position, index, object);
    transform(state_.eye_from_object, object, eye);
    for (size_t i = 0; i < kMaxClipPlanes; ++i) v.user[i] = dot(state_.clip_planes.planes[i], eye);
  }
  if (attributes_) shade_attributes(index, v);
  return v;
}

void Feedback::lines() {
  const uint32_t n = packet_.index_count;
  if (packet_.primitive == Primitive::lines) {
    for (uint32_t i = 0; i + 1 < n; i += 2) line(vertex(i), vertex(i + 1), true);
    return;
  }
  if (n < 2) return;
  for (uint32_t i = 0; i + 1 < n; ++i) line(vertex(i), vertex(i + 1), i == 0 && !packet_.continues);
  if (packet_.primitive == Primitive::line_loop) line(vertex(n - 1), vertex(0), false);
}

void Feedback::whole_polygon() {
  if (packet_.index_count < 3) return;
  polygon_.clear();
  for (uint32_t i = 0; i < packet_.index_count; ++i) polygon_.push_back(vertex(i));
  polygon(0);
}

// Polygons of `size` vertices, each `step` further; the one given last in the list provokes.
void Feedback::groups(uint32_t step, Order order, uint32_t size) {
  for (uint32_t first = 0; first + size <= packet_.index_count; first += step) {
    polygon_.clear();
    uint32_t provoking = 0;
    for (uint32_t i = 0; i < size; ++i) {
      polygon_.push_back(vertex(first + order.at[i]));
      if (order.at[i] == size - 1) provoking = i;
    }
    polygon(provoking);
  }
}

void Feedback::triangle_strip() {
  for (uint32_t k = 0; k + 2 < packet_.index_count; ++k) {
    polygon_ = {vertex(k + (k & 1)), vertex(k + 1 - (k & 1)), vertex(k + 2)};
    polygon(2);
  }
}

void Feedback::triangle_fan() {
  for (uint32_t k = 1; k + 1 < packet_.index_count; ++k) {
    polygon_ = {vertex(0), vertex(k), vertex(k + 1)};
    polygon(2);
  }
}

void Feedback::point(const Vertex& v) {
  if (is_finite(v.clip) && is_inside(v)) sink_.point(result(v, false));
}

void Feedback::line(Vertex a, Vertex b, bool reset) {
  if (!is_finite(a.clip) || !is_finite(b.clip)) return;
  if (state_.raster.flat_shading) std::copy_n(b.front, 4, a.front);
  for (int i = 0; i < kFrustumPlanes + kMaxClipPlanes; ++i) {
    if (!is_cut_by(i)) continue;
    const double d_a = plane_distance(a, i), d_b = plane_distance(b, i);
    if (d_a < 0 && d_b < 0) return;
    if (d_a < 0) a = crossing(b, d_b, a, d_a);
    if (d_b < 0) b = crossing(a, d_a, b, d_b);
  }
  if (a.clip.w > 0 && b.clip.w > 0) sink_.line(result(a, false), result(b, false), reset);
}

// Sutherland and Hodgman's step. A vertex where the polygon comes back in goes on along the edge it lies on.
// One where it leaves starts a new edge: of the polygon's boundary at a user plane, as outlines are drawn; no
// edge at the frustum, where they just end.
bool Feedback::cut_polygon(int plane) {
  scratch_.clear();
  const Vertex* previous = &polygon_.back();
  double d_previous = plane_distance(*previous, plane);
  for (const Vertex& current : polygon_) {
    const double d = plane_distance(current, plane);
    if (d >= 0 && d_previous < 0) {
      scratch_.push_back(crossing(current, d, *previous, d_previous));
      scratch_.back().edge = previous->edge;
    }
    if (d < 0 && d_previous >= 0) {
      scratch_.push_back(crossing(*previous, d_previous, current, d));
      scratch_.back().edge = plane >= kFrustumPlanes;
    }
    if (d >= 0) scratch_.push_back(current);
    previous = &current;
    d_previous = d;
  }
  polygon_.swap(scratch_);
  return polygon_.size() >= 3;
}

double Feedback::signed_area() const {
  const auto x = [this](const Vertex& v) { return v.clip.x / v.clip.w * window_.scale_x; };
  const auto y = [this](const Vertex& v) { return v.clip.y / v.clip.w * window_.scale_y; };
  const Vertex& apex = polygon_[0];
  double area = 0;
  for (size_t i = 1; i + 1 < polygon_.size(); ++i) {
    const Vertex &b = polygon_[i], &c = polygon_[i + 1];
    area += (x(b) - x(apex)) * (y(c) - y(apex)) - (x(c) - x(apex)) * (y(b) - y(apex));
  }
  return area;
}

void Feedback::polygon(uint32_t provoking) {
  for (const Vertex& v : polygon_) {
    if (!is_finite(v.clip)) return;
  }
  if (state_.raster.flat_shading) {
    const Vertex flat = polygon_[provoking];
    for (Vertex& v : polygon_) {
      std::copy_n(flat.front, 4, v.front);
      std::copy_n(flat.back, 4, v.back);
    }
  }
  for (int i = 0; i < kFrustumPlanes + kMaxClipPlanes; ++i) {
    if (is_cut_by(i) && !cut_polygon(i)) return;
  }
  for (const Vertex& v : polygon_) {
    if (!(v.clip.w > 0)) return;
  }
  const bool back = (signed_area() > 0) != state_.raster.front_is_ccw;
  if (back ? state_.raster.cull_back : state_.raster.cull_front) return;
  if ((back ? state_.polygon.back : state_.polygon.front) != PolygonMode::fill) return outline(back);
  results_.clear();
  for (const Vertex& v : polygon_) results_.push_back(result(v, back));
  sink_.polygon(results_);
}

// Spec 3.5.4: vertices and edges that are marked as the polygon's boundary.
void Feedback::outline(bool back) {
  const bool as_points = (back ? state_.polygon.back : state_.polygon.front) == PolygonMode::point;
  bool reset = true;
  for (size_t i = 0; i < polygon_.size(); ++i) {
    if (!polygon_[i].edge) continue;
    if (as_points) {
      sink_.point(result(polygon_[i], back));
    } else {
      sink_.line(result(polygon_[i], back), result(polygon_[(i + 1) % polygon_.size()], back), reset);
      reset = false;
    }
  }
}

FeedbackVertex Feedback::result(const Vertex& v, bool back) const {
  const ClipVertex& c = v.clip;
  constexpr double kPixel = 1.0 / kSubpixelScale;
  FeedbackVertex out;
  out.x = (c.x / c.w * window_.scale_x + window_.offset_x) * kPixel;
  out.y = (c.y / c.w * window_.scale_y + window_.offset_y) * kPixel;
  const double z = c.z / c.w * window_.depth_scale + window_.depth_offset;
  out.z = z < window_.depth_low ? window_.depth_low : (z > window_.depth_high ? window_.depth_high : z);
  out.w = c.w;
  const double* color = back ? v.back : v.front;
  out.color = {float(color[0]), float(color[1]), float(color[2]), float(color[3])};
  out.s = v.tex_coord[0], out.t = v.tex_coord[1], out.r = v.tex_coord[2], out.q = v.tex_coord[3];
  return out;
}

}  // namespace

void Device::feedback(const DrawPacket& packet, FeedbackSink& sink) {
  if (packet.batch.count == 0) return;
  Feedback(packet, sink).run();
}

}  // namespace halfspace::raster
