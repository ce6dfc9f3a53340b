#include "tests/oracle/vertex.h"

#include <algorithm>
#include <cstring>

#include "tests/oracle/lighting.h"

namespace halfspace::oracle {
namespace {

using Float4 = std::array<float, 4>;

// Components that are not given are 0, 0, 0, 1 (spec 2.7).
Float4 fetch(const raster::AttributeStream& stream, uint32_t index, const Float4& absent) {
  if (stream.data == nullptr) return absent;
  float v[4] = {0, 0, 0, 1};
  raster::read_element(stream, index, v);
  return {v[0], v[1], v[2], v[3]};
}

std::array<Wide, 4> times(const std::array<double, 16>& m, const std::array<Wide, 4>& v) {
  std::array<Wide, 4> out;
  for (size_t r = 0; r < 4; ++r)
    out[r] = wide(m[r]) * v[0] + wide(m[4 + r]) * v[1] + wide(m[8 + r]) * v[2] + wide(m[12 + r]) * v[3];
  return out;
}

std::array<Wide, 4> widened(const Float4& v) { return {wide(v[0]), wide(v[1]), wide(v[2]), wide(v[3])}; }
Real4 reals(const Float4& v) { return {real(v[0]), real(v[1]), real(v[2]), real(v[3])}; }

// What no arithmetic could make sense of is held to a range whose products stay finite; NaN is 0.
Wide bounded(Wide v) {
  constexpr double kMost = 1e30;
  return v == v ? held(v, wide(-kMost), wide(kMost)) : wide(0);
}

// Spec 2.12: a user clip plane keeps what lies where p . (x_e, y_e, z_e, w_e) >= 0.
void measure_user_planes(const raster::ClipPlaneState& planes, const std::array<Wide, 4>& eye,
                         Corner& corner) {
  for (size_t i = 0; i < planes.planes.size(); ++i) {
    if ((planes.enabled >> i & 1) == 0) continue;
    Wide sum = 0;
    for (size_t k = 0; k < 4; ++k) sum += wide(planes.planes[i][k]) * eye[k];
    corner.user[i] = is_finite(sum) ? sum : wide(-1);
  }
}

// Spec 2.14.3: the current colour in place of properties of the material.
void track_color(const raster::LightingState::ColorMaterial& tracked, const raster::Color& color,
                 raster::Material& material) {
  if (tracked.ambient) material.ambient = color;
  if (tracked.diffuse) material.diffuse = color;
  if (tracked.specular) material.specular = color;
  if (tracked.emission) material.emission = color;
}

void light(const raster::DrawState& state, const raster::MaterialPair& given, const Float4& position,
           const Float4& normal, const raster::Color& color, Vertex& out) {
  raster::MaterialPair materials = given;
  track_color(state.lighting.color_material_front, color, materials.front);
  track_color(state.lighting.color_material_back, color, materials.back);
  const Real4 at = reals(position);
  const LitVertex lit =
      light_vertex(state, materials, at, {real(normal[0]), real(normal[1]), real(normal[2])});
  const Real4& back = state.lighting.two_sided ? lit.back : lit.front;
  for (size_t k = 0; k < 4; ++k)
    out.corner.value[kRed + k] = static_cast<Wide>(lit.front[k]), out.back[k] = static_cast<Wide>(back[k]);
  out.doubtful = lit.margin < 1e-5L;
}

// Spec 2.11.4: texture coordinates are generated, then go through the texture matrix.
void make_coords(const raster::DrawState& state, const Float4& position, const Float4& normal,
                 const Float4& given, Corner& corner) {
  Real4 coord = reals(given);
  if (state.tex_gen.any())
    coord = generate(state, reals(position), {real(normal[0]), real(normal[1]), real(normal[2])}, coord);
  std::array<Wide, 4> v;
  for (size_t k = 0; k < 4; ++k) v[k] = bounded(static_cast<Wide>(coord[k]));
  if (!state.texture.matrix_is_identity) v = times(state.texture.matrix, v);
  for (size_t k = 0; k < 4; ++k) corner.value[kCoordS + k] = bounded(v[k]);
}

// Spec 3.10: c is the eye-coordinate distance, taken as |z_e|. A vertex at infinity is very far away.
Wide fog_distance(const std::array<Wide, 4>& eye) {
  const Wide w = eye[3] == 0 ? wide(1e-12) : eye[3];
  return bounded(magnitude(eye[2] / w));
}

}  // namespace

Vertex shade_vertex(const raster::DrawState& state, const raster::VertexBatch& batch,
                    std::span<const raster::MaterialPair> materials, uint32_t index) {
  const Float4 position = fetch(batch.position, index, {0, 0, 0, 1});
  const Float4 normal = fetch(batch.normal, index, {0, 0, 1, 0});
  const Float4 color = fetch(batch.color, index, {1, 1, 1, 1});
  Vertex out;
  const std::array<Wide, 4> clip = times(state.clip_from_object, widened(position));
  out.corner.x = clip[0], out.corner.y = clip[1], out.corner.z = clip[2], out.corner.w = clip[3];
  for (const Wide c : clip) out.usable = out.usable && magnitude(c) <= wide(1.7976931348623157e308);
  const std::array<Wide, 4> eye = times(state.eye_from_object, widened(position));
  measure_user_planes(state.clip_planes, eye, out.corner);
  if (state.lighting.enabled) {
    const bool own = batch.material_index != nullptr && !materials.empty();
    light(state, own ? materials[batch.material_index[index]] : state.lighting.material, position, normal,
          {color[0], color[1], color[2], color[3]}, out);
  } else {
    for (size_t k = 0; k < 4; ++k)
      out.corner.value[kRed + k] = out.back[k] = held(wide(color[k]), wide(0), wide(1));
  }
  make_coords(state, position, normal, fetch(batch.tex_coord, index, {0, 0, 0, 1}), out.corner);
  out.corner.value[kFogDistance] = fog_distance(eye);
  out.corner.edge = batch.edge_flag == nullptr || batch.edge_flag[index] != 0;
  return out;
}

}  // namespace halfspace::oracle
