#include "raster/vertex/shade_point.h"

#include <cstring>

#include "raster/vertex/vertex_stage.h"

namespace halfspace::raster {
namespace {

constexpr uint16_t kOutOfView =
    kOutLeft | kOutRight | kOutBottom | kOutTop | kOutNear | kOutFar | kOutW | kOutNotFinite;

void eye_position(const DrawState& state, const AttributeStream& position, double out[4]) {
  float v[4] = {0, 0, 0, 1};
  if (position.data != nullptr) std::memcpy(v, position.data, position.size * sizeof(float));
  const auto& m = state.eye_from_object;
  for (size_t r = 0; r < 4; ++r)
    out[r] = ((m[r] * static_cast<double>(v[0]) + m[4 + r] * static_cast<double>(v[1])) +
              m[8 + r] * static_cast<double>(v[2])) +
             m[12 + r] * static_cast<double>(v[3]);
}

bool cut_by_user_planes(const ClipPlaneState& planes, const double eye[4]) {
  for (size_t i = 0; i < planes.planes.size(); ++i) {
    const auto& p = planes.planes[i];
    const bool on = (planes.enabled >> i & 1) != 0;
    if (on && !(((p[0] * eye[0] + p[1] * eye[1]) + p[2] * eye[2]) + p[3] * eye[3] >= 0)) return true;
  }
  return false;
}

// Spec 2.10.1, without snapping.
void to_window(const Viewport& v, const ClipVertex& clip, ShadedPoint& out) {
  out.x = v.x + (clip.x / clip.w + 1) * (v.width * 0.5);
  out.y = v.y + (clip.y / clip.w + 1) * (v.height * 0.5);
  const double z = v.depth_near + (clip.z / clip.w + 1) * ((v.depth_far - v.depth_near) * 0.5);
  out.z = z > 0 ? (z < 1 ? z : 1) : 0;
  out.w = clip.w;
}

}  // namespace

ShadedPoint shade_point(const DrawState& state, const VertexBatch& batch) {
  VertexBatch one = batch;
  one.count = 1;
  ShadedVertices vertices;
  vertices.layout = choose_layout(state, one);
  std::vector<std::byte> record(vertices.layout.stride());
  vertices.records = record.data();
  vertices.count = 1;
  vertices.outcodes.resize(1);
  vertices.clip = {one.position, state};
  shade_vertices(state, one, 0, 1, vertices);

  ShadedPoint point;
  double eye[4];
  eye_position(state, batch.position, eye);
  point.valid = (vertices.outcodes[0] & kOutOfView) == 0 && !cut_by_user_planes(state.clip_planes, eye);
  if (!point.valid) return point;
  to_window(state.viewport, vertices.clip[0], point);
  VertexAttributes attributes;
  shade_attributes(state, one, {}, {&attributes, 1});
  point.eye_distance = static_cast<double>(attributes.eye_distance);
  point.color = attributes.color;
  for (int k = 0; k < 4; ++k) point.tex_coord[k] = static_cast<double>(attributes.tex_coord[k]);
  return point;
}

}  // namespace halfspace::raster
