#include "raster/vertex/tex_coord.h"

#include <cmath>
#include <cstring>

namespace halfspace::raster {
namespace {

void first_element(const AttributeStream& stream, double out[4]) {
  if (stream.data == nullptr) return;
  float v[4];
  std::memcpy(v, stream.data, stream.size * sizeof(float));
  for (int k = 0; k < stream.size; ++k) out[k] = static_cast<double>(v[k]);
}

void times(const double* m, const double v[4], double out[4]) {
  for (int r = 0; r < 4; ++r) out[r] = ((m[r] * v[0] + m[4 + r] * v[1]) + m[8 + r] * v[2]) + m[12 + r] * v[3];
}

double dot(const std::array<double, 4>& p, const double v[4]) {
  return ((p[0] * v[0] + p[1] * v[1]) + p[2] * v[2]) + p[3] * v[3];
}

// Scaled to length 1, or left alone where it has none.
void normalize(double v[3]) {
  const double length = std::sqrt((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]);
  if (!(length > 0)) return;
  for (int k = 0; k < 3; ++k) v[k] /= length;
}

struct EyeVertex {
  double object[4] = {0, 0, 0, 1}, eye[4], normal[3];

  EyeVertex(const DrawState& state, const VertexBatch& batch) {
    first_element(batch.position, object);
    times(state.eye_from_object.data(), object, eye);
    double n[4] = {0, 0, 1, 0};
    first_element(batch.normal, n);
    const auto& m = state.normal_from_object;
    for (size_t r = 0; r < 3; ++r) normal[r] = (m[r] * n[0] + m[3 + r] * n[1]) + m[6 + r] * n[2];
    if (state.normalize) normalize(normal);
  }

  // r + (0, 0, 1), where r is the reflection of the direction from the eye; out[3] is twice its length.
  void reflection(double out[4]) const {
    double u[3] = {eye[0], eye[1], eye[2]};
    if (eye[3] != 0)
      for (double& c : u) c /= eye[3];
    normalize(u);
    const double twice = 2 * ((normal[0] * u[0] + normal[1] * u[1]) + normal[2] * u[2]);
    for (int k = 0; k < 3; ++k) out[k] = u[k] - normal[k] * twice;
    out[2] += 1;
    out[3] = 2 * std::sqrt((out[0] * out[0] + out[1] * out[1]) + out[2] * out[2]);
  }
};

double generated(const TexGenCoord& coord, const EyeVertex& vertex, size_t which, double current) {
  switch (coord.mode) {
    case TexGenMode::off:
      return current;
    case TexGenMode::object_linear:
      return dot(coord.object_plane, vertex.object);
    case TexGenMode::eye_linear:
      return dot(coord.eye_plane, vertex.eye);
    case TexGenMode::sphere_map:
      break;
  }
  double r[4];
  vertex.reflection(r);
  return which < 2 && r[3] > 0 ? r[which] / r[3] + 0.5 : 0.5;
}

}  // namespace

void full_tex_coord(const DrawState& state, const VertexBatch& batch, double out[4]) {
  double coord[4] = {0, 0, 0, 1};
  first_element(batch.tex_coord, coord);
  if (state.tex_gen.any()) {
    const EyeVertex vertex(state, batch);
    for (size_t k = 0; k < 4; ++k) coord[k] = generated(state.tex_gen.coord[k], vertex, k, coord[k]);
  }
  times(state.texture.matrix.data(), coord, out);
}

}  // namespace halfspace::raster
