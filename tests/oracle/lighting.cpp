#include "tests/oracle/lighting.h"

#include <cmath>

namespace halfspace::oracle {
namespace {

using raster::Color;

long double dot(const Real3& a, const Real3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
long double length(const Real3& v) { return std::sqrt(dot(v, v)); }
Real3 unit(const Real3& v) {
  const long double l = length(v);
  return l > 0 ? Real3{v[0] / l, v[1] / l, v[2] / l} : Real3{0, 0, 0};
}
Real3 plus(const Real3& a, const Real3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
long double not_negative(long double v) { return v > 0 ? v : 0; }
template <class T>
long double real(T v) {
  return static_cast<long double>(v);
}
Real4 wide(const Color& c) { return {real(c.r), real(c.g), real(c.b), real(c.a)}; }

// The spec's arrow: the unit vector from a to b, either of which may be infinitely far away.
Real3 arrow(const Real4& a, const Real4& b) {
  if (b[3] == 0 && a[3] != 0) return unit({b[0], b[1], b[2]});
  if (a[3] == 0 && b[3] != 0) return unit({-a[0], -a[1], -a[2]});
  return unit({b[0] / b[3] - a[0] / a[3], b[1] / b[3] - a[1] / a[3], b[2] / b[3] - a[2] / a[3]});
}

long double attenuation(const raster::Light& light, const Real4& v, const Real4& p) {
  if (p[3] == 0) return 1;
  const long double d =
      length({p[0] / p[3] - v[0] / v[3], p[1] / p[3] - v[1] / v[3], p[2] / p[3] - v[2] / v[3]});
  return 1 / (real(light.constant_attenuation) + real(light.linear_attenuation) * d +
              real(light.quadratic_attenuation) * d * d);
}

struct Spot {
  long double factor, margin, cosine;
};
constexpr long double kLeastJump = 1e-5L;

Spot spot(const raster::Light& light, const Real4& v, const Real4& p) {
  if (light.spot_cutoff == 180) return {1, 1, 1};
  const Real3 s =
      unit({real(light.spot_direction[0]), real(light.spot_direction[1]), real(light.spot_direction[2])});
  const long double cosine = dot(arrow(p, v), s);
  const long double edge = std::cos(real(light.spot_cutoff) * 3.14159265358979323846264338327950288L / 180);
  const long double margin = std::fabs(cosine - edge);
  return {cosine >= edge ? std::pow(cosine, real(light.spot_exponent)) : 0, margin, cosine};
}

struct Sums {
  Real3 color{0, 0, 0};
  long double margin = 1;
};

void add_light(const raster::DrawState& state, const raster::Light& light, const raster::Material& material,
               const Real4& v, const Real3& n, Sums& sums) {
  const Real4 p{real(light.position[0]), real(light.position[1]), real(light.position[2]),
                real(light.position[3])};
  const Real3 to_light = arrow(v, p);
  const Real3 to_eye = state.lighting.local_viewer ? arrow(v, {0, 0, 0, 1}) : Real3{0, 0, 1};
  const Real3 half = unit(plus(to_light, to_eye));
  const long double n_dot_l = dot(n, to_light);
  const Spot cone = spot(light, v, p);
  const long double weight = attenuation(light, v, p) * cone.factor;
  const long double shine = n_dot_l > 0 ? std::pow(not_negative(dot(n, half)), real(material.shininess)) : 0;
  const Real4 ma = wide(material.ambient), md = wide(material.diffuse), ms = wide(material.specular);
  const Real4 la = wide(light.ambient), ld = wide(light.diffuse), ls = wide(light.specular);
  for (size_t k = 0; k < 3; ++k) {
    sums.color[k] += weight * (ma[k] * la[k] + not_negative(n_dot_l) * md[k] * ld[k] + shine * ms[k] * ls[k]);
  }
  // Where it jumps nothing is to be seen of a jump by nothing.
  const long double rim = std::pow(not_negative(dot(n, half)), real(material.shininess));
  const auto brightest = [](const Real4& m, const Real4& l) {
    return std::max({m[0] * l[0], m[1] * l[1], m[2] * l[2]});
  };
  const bool shines = length(n) > 0 && weight * rim * brightest(ms, ls) > kLeastJump;
  if (shines) sums.margin = std::min(sums.margin, std::fabs(n_dot_l));
  if (attenuation(light, v, p) * std::pow(not_negative(cone.cosine), real(light.spot_exponent)) > kLeastJump)
    sums.margin = std::min(sums.margin, cone.margin);
}

Real4 light_side(const raster::DrawState& state, const raster::Material& material, const Real4& v,
                 const Real3& n, long double& margin) {
  Sums sums;
  const Real4 me = wide(material.emission), ma = wide(material.ambient),
              scene = wide(state.lighting.model_ambient);
  for (size_t k = 0; k < 3; ++k) sums.color[k] = me[k] + ma[k] * scene[k];
  for (const raster::Light& light : state.lighting.lights) {
    if (light.enabled) add_light(state, light, material, v, n, sums);
  }
  margin = sums.margin;
  Real4 result{sums.color[0], sums.color[1], sums.color[2], real(material.diffuse.a)};
  for (long double& c : result) c = c < 0 ? 0 : c > 1 ? 1 : c;
  return result;
}

}  // namespace

Real4 eye_position(const raster::DrawState& state, const Real4& p) {
  const auto& m = state.eye_from_object;
  Real4 eye;
  for (size_t r = 0; r < 4; ++r)
    eye[r] = real(m[r]) * p[0] + real(m[4 + r]) * p[1] + real(m[8 + r]) * p[2] + real(m[12 + r]) * p[3];
  return eye;
}

Real3 eye_normal(const raster::DrawState& state, const Real3& n) {
  const auto& m = state.normal_from_object;
  Real3 eye;
  for (size_t r = 0; r < 3; ++r) eye[r] = real(m[r]) * n[0] + real(m[3 + r]) * n[1] + real(m[6 + r]) * n[2];
  return state.normalize ? unit(eye) : eye;
}

LitVertex light_vertex(const raster::DrawState& state, const raster::MaterialPair& materials,
                       const Real4& position, const Real3& normal) {
  const Real4 v = eye_position(state, position);
  const Real3 n = eye_normal(state, normal);
  LitVertex result;
  result.front = light_side(state, materials.front, v, n, result.margin);
  result.back = light_side(state, materials.back, v, {-n[0], -n[1], -n[2]}, result.margin);
  return result;
}

Real4 generate(const raster::DrawState& state, const Real4& position, const Real3& normal,
               const Real4& given) {
  const Real4 v = eye_position(state, position);
  const Real3 n = eye_normal(state, normal);
  const Real3 u = arrow({0, 0, 0, 1}, v);
  const long double along = 2 * dot(n, u);
  const Real3 r{u[0] - n[0] * along, u[1] - n[1] * along, u[2] - n[2] * along};
  const long double m = 2 * std::sqrt(r[0] * r[0] + r[1] * r[1] + (r[2] + 1) * (r[2] + 1));
  Real4 result = given;
  for (size_t k = 0; k < 4; ++k) {
    const raster::TexGenCoord& coord = state.tex_gen.coord[k];
    const auto plane = [](const std::array<double, 4>& p, const Real4& at) {
      return real(p[0]) * at[0] + real(p[1]) * at[1] + real(p[2]) * at[2] + real(p[3]) * at[3];
    };
    if (coord.mode == raster::TexGenMode::object_linear) result[k] = plane(coord.object_plane, position);
    if (coord.mode == raster::TexGenMode::eye_linear) result[k] = plane(coord.eye_plane, v);
    if (coord.mode == raster::TexGenMode::sphere_map) result[k] = r[k] / m + 0.5L;
  }
  return result;
}

}  // namespace halfspace::oracle
