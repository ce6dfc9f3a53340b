#include "raster/vertex/exact_attributes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "raster/vertex/lighting.h"
#include "raster/vertex/vertex_kernels.h"

namespace halfspace::raster {
namespace {

#define HWY_INLINE inline
#include "raster/exact_math.inl"
#undef HWY_INLINE

struct Vector {
  double x, y, z;
};
Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector operator*(const Vector& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Zero for what has no direction. By its longest component first, so that no square overflows or vanishes.
Vector unit(const Vector& v) {
  const double longest = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  if (!(longest > 0) || !std::isfinite(longest)) return {0, 0, 0};
  const Vector scaled = {v.x / longest, v.y / longest, v.z / longest};
  const double length = std::sqrt(dot(scaled, scaled));
  return {scaled.x / length, scaled.y / length, scaled.z / length};
}
double length(const Vector& v) {
  const double longest = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  if (!(longest > 0) || !std::isfinite(longest)) return longest;
  const Vector scaled = {v.x / longest, v.y / longest, v.z / longest};
  return std::sqrt(dot(scaled, scaled)) * longest;
}

struct Rgba {
  double c[4];
};
Rgba wide(const Color& c) { return {{double(c.r), double(c.g), double(c.b), double(c.a)}}; }
double positive(double v) { return v > 0 ? v : 0; }  // NaN too
double clamp_unit(double v) { return v > 0 ? std::min(v, 1.0) : 0; }

void load(const AttributeStream& stream, uint32_t i, int most, double* out) {
  if (!stream.data) return;
  float v[4];
  read_element(stream, i, v);
  const int size = std::min<int>(stream.size, most);
  for (int k = 0; k < size; ++k) out[k] = double(v[k]);
}

double bounded(double v) {
  const auto most = double(kMaxTexCoord);
  if (v >= -most && v <= most) return v;
  return v > 0 ? most : (v < 0 ? -most : 0);
}

// One vertex.
class ExactVertex {
 public:
  ExactVertex(const DrawState& state, const VertexBatch& batch, uint32_t i) : state_(state) {
    load(batch.position, i, 4, position_);
    load(batch.normal, i, 3, normal_in_);
    load(batch.color, i, 4, color_);
    load(batch.tex_coord, i, 4, tex_coord_);
    if (!batch.color.data) std::fill_n(color_, 4, 1.0);
    find_eye();
    find_normal();
  }

  double eye_distance() const { return bounded(std::fabs(eye_.z)); }

  Rgba lit(const Material& material, const LightingState::ColorMaterial& tracked, double side) const {
    const Rgba own{{color_[0], color_[1], color_[2], color_[3]}};
    const Rgba ambient = tracked.ambient ? own : wide(material.ambient);
    const Rgba diffuse = tracked.diffuse ? own : wide(material.diffuse);
    const Rgba specular = tracked.specular ? own : wide(material.specular);
    const Rgba emission = tracked.emission ? own : wide(material.emission);
    const Rgba model = wide(state_.lighting.model_ambient);
    Rgba sum = emission;
    for (int k = 0; k < 3; ++k) sum.c[k] += ambient.c[k] * model.c[k];
    for (const Light& light : state_.lighting.lights) {
      if (!light.enabled) continue;
      const Shares shares = shares_of(light, double(material.shininess), side);
      const Rgba la = wide(light.ambient), ld = wide(light.diffuse), ls = wide(light.specular);
      for (int k = 0; k < 3; ++k) {
        sum.c[k] += shares.weight * (ambient.c[k] * la.c[k] + shares.diffuse * diffuse.c[k] * ld.c[k] +
                                     shares.specular * specular.c[k] * ls.c[k]);
      }
    }
    sum.c[3] = diffuse.c[3];
    for (double& c : sum.c) c = clamp_unit(c);
    return sum;
  }

  // s t r q, through the texture matrix.
  void tex_coord(double (&out)[4]) const {
    double v[4];
    for (int k = 0; k < 4; ++k) v[k] = bounded(tex_coord_[k]);
    if (state_.tex_gen.any()) generate(v);
    const auto& m = state_.texture.matrix;
    for (size_t r = 0; r < 4; ++r) {
      out[r] = state_.texture.matrix_is_identity
                   ? v[r]
                   : bounded(((m[r] * v[0] + m[4 + r] * v[1]) + m[8 + r] * v[2]) + m[12 + r] * v[3]);
    }
  }

 private:
  struct Shares {
    double weight, diffuse, specular;
  };

  void find_eye() {
    const auto& m = state_.eye_from_object;
    double e[4];
    for (size_t r = 0; r < 4; ++r) {
      e[r] = ((m[r] * position_[0] + m[4 + r] * position_[1]) + m[8 + r] * position_[2]) +
             m[12 + r] * position_[3];
    }
    const double w = e[3] == 0 ? 1e-12 : e[3];  // at infinity: very far away, as the kernels take it
    eye_ = {e[0] / w, e[1] / w, e[2] / w};
  }

  void find_normal() {
    const auto& m = state_.normal_from_object;
    const double* n = normal_in_;
    const auto row = [&](size_t r) { return (m[r] * n[0] + m[3 + r] * n[1]) + m[6 + r] * n[2]; };
    normal_ = {row(0), row(1), row(2)};
    if (!std::isfinite(normal_.x + normal_.y + normal_.z)) normal_ = {0, 0, 0};
    if (state_.normalize) normal_ = unit(normal_);
  }

  double power(double x, double s) const {
    if (state_.accuracy.power == Level::exact) return ExactPower(x, s);
    const auto base = float(x), exponent = float(s);
    float out;
    raster::power(&base, &exponent, &out, 1, state_.accuracy.power);
    return double(out);
  }

  // Spec 2.14.1. side: 1 for the front, -1 for the back.
  Shares shares_of(const Light& light, double shininess, double side) const {
    const auto& p = light.position;
    const bool infinite = p[3] == 0;
    const double sign = p[3] < 0 ? -1 : 1;
    const Vector at{p[0] / p[3], p[1] / p[3], p[2] / p[3]};
    const bool local = !infinite && std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z);
    const Vector path = local ? at - eye_ : Vector{sign * p[0], sign * p[1], sign * p[2]};
    const Vector to_light = unit(path);
    Shares shares{1, 0, 0};
    if (local) {
      const double d = length(path);
      const double sum = double(light.constant_attenuation) + double(light.linear_attenuation) * d +
                         double(light.quadratic_attenuation) * d * d;
      shares.weight = 1 / (sum > 1e-15 ? sum : 1e-15);
    }
    if (light.spot_cutoff != 180) shares.weight *= spot_share(light, to_light);
    const double cosine = side * dot(normal_, to_light);
    shares.diffuse = positive(cosine);
    if (!(cosine > 0)) return shares;
    const Vector to_eye = state_.lighting.local_viewer ? unit(eye_ * -1) : Vector{0, 0, 1};
    shares.specular = power(positive(side * dot(normal_, unit(to_light + to_eye))), shininess);
    return shares;
  }

  double spot_share(const Light& light, const Vector& to_light) const {
    const auto& s = light.spot_direction;
    const double cosine = -dot(to_light, unit({s[0], s[1], s[2]}));
    if (!(cosine >= light.spot_cosine)) return 0;
    return light.spot_exponent == 0 ? 1 : power(positive(cosine), double(light.spot_exponent));
  }

  // Spec 2.11.4.
  void generate(double (&v)[4]) const {
    const Vector u = unit(eye_);
    const Vector r = u - normal_ * (2 * dot(normal_, u)) + Vector{0, 0, 1};
    const double m = 2 * std::sqrt(dot(r, r));
    const double sphere[2] = {m > 0 ? r.x / m + 0.5 : 0.5, m > 0 ? r.y / m + 0.5 : 0.5};
    for (size_t k = 0; k < 4; ++k) {
      const TexGenCoord& coord = state_.tex_gen.coord[k];
      if (coord.mode == TexGenMode::off) continue;
      if (coord.mode == TexGenMode::sphere_map)
        v[k] = k < 2 ? sphere[k] : v[k];
      else
        v[k] = bounded(coord.mode == TexGenMode::object_linear ? on_object(coord.object_plane)
                                                               : on_object(in_object(coord.eye_plane)));
    }
  }
  double on_object(const std::array<double, 4>& p) const {
    return ((p[0] * position_[0] + p[1] * position_[1]) + p[2] * position_[2]) + p[3] * position_[3];
  }
  std::array<double, 4> in_object(const std::array<double, 4>& p) const {
    const auto& m = state_.eye_from_object;
    std::array<double, 4> out;
    for (size_t i = 0; i < 4; ++i)
      out[i] = ((p[0] * m[4 * i] + p[1] * m[4 * i + 1]) + p[2] * m[4 * i + 2]) + p[3] * m[4 * i + 3];
    return out;
  }

  const DrawState& state_;
  double position_[4] = {0, 0, 0, 1}, normal_in_[3] = {0, 0, 1}, color_[4] = {0, 0, 0, 1},
         tex_coord_[4] = {0, 0, 0, 1};
  Vector eye_, normal_;
};

class RecordWriter {
 public:
  RecordWriter(const VertexLayout& layout, std::byte* record)
      : low_(layout.low), floats_(record + sizeof(VertexHead)) {}
  void put(int place, double value) const {
    const auto high = float(value);
    store(place, high);
    if (low_ >= 0) store(place + low_, float(value - double(high)));
  }
  // What stands there is all there is.
  void keep(int place) const {
    if (low_ >= 0) store(place + low_, 0);
  }

 private:
  void store(int place, float value) const {
    std::memcpy(floats_ + size_t(place) * sizeof(float), &value, sizeof value);
  }
  int low_;
  std::byte* floats_;
};

void put_colors(const DrawState& state, const MaterialPair& material, const VertexLayout& layout,
                const ExactVertex& vertex, const RecordWriter& out) {
  const LightingState& lighting = state.lighting;
  for (int side = 0; side < 2; ++side) {
    const int place = side == 0 ? layout.color : layout.back_color;
    if (place < 0) continue;
    if (!lighting.enabled) {
      for (int k = 0; k < 4; ++k) out.keep(place + k);
      continue;
    }
    const Rgba color = side == 0 ? vertex.lit(material.front, lighting.color_material_front, 1)
                                 : vertex.lit(material.back, lighting.color_material_back, -1);
    for (int k = 0; k < 4; ++k) out.put(place + k, color.c[k]);
  }
}

}  // namespace

void shade_exactly(const DrawState& state, const VertexBatch& batch, std::span<const MaterialPair> materials,
                   const VertexLayout& layout, int tex_coord_count, uint32_t first, uint32_t count,
                   std::byte* records) {
  const bool own_materials = batch.material_index && !materials.empty();
  for (uint32_t i = first; i < first + count; ++i) {
    const ExactVertex vertex(state, batch, i);
    const RecordWriter out(layout, records + size_t{i} * layout.stride());
    put_colors(state, own_materials ? materials[batch.material_index[i]] : state.lighting.material, layout,
               vertex, out);
    if (layout.fog >= 0) out.put(layout.fog, vertex.eye_distance());
    if (layout.tex_coord < 0) continue;
    double v[4];
    vertex.tex_coord(v);
    if (tex_coord_count == 3) v[2] = v[3];
    for (int k = 0; k < tex_coord_count; ++k) out.put(layout.tex_coord + k, v[k]);
  }
}

}  // namespace halfspace::raster
