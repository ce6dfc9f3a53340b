#include "raster/vertex/lighting.h"

#include <algorithm>
#include <cmath>

namespace halfspace::raster {
namespace {

struct Vector {
  double x, y, z;
};

// Scaled by its longest component first, so that no square overflows or vanishes. Zero and what is not finite
// stay zero: a light without direction gives no diffuse light.
Vector unit(Vector v) {
  const double longest = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  if (!(longest > 0) || !std::isfinite(longest)) return {0, 0, 0};
  v = {v.x / longest, v.y / longest, v.z / longest};
  const double length = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
  return {v.x / length, v.y / length, v.z / length};
}

void store(const Vector& v, float (&out)[3]) {
  out[0] = float(v.x), out[1] = float(v.y), out[2] = float(v.z);
}

void store(const Color& c, float (&out)[3]) { out[0] = c.r, out[1] = c.g, out[2] = c.b; }
void store(const Color& c, float (&out)[4]) { out[0] = c.r, out[1] = c.g, out[2] = c.b, out[3] = c.a; }

bool is_black(const Color& c) { return c.r == 0 && c.g == 0 && c.b == 0; }

// Farther away than this, float squares of a distance would overflow. Such a light is the same for all
// vertices: so is its direction, and how far it is.
constexpr double kFarAway = 1e15;

// Spec 2.14.1, for the distance of P / w from the origin. Table 2.10: w = 0 is not attenuated, whatever is
// set.
float far_attenuation(const Light& light) {
  const auto& p = light.position;
  if (p[3] == 0) return 1;
  const double longest = std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])});
  const double x = p[0] / longest, y = p[1] / longest, z = p[2] / longest;
  const double distance = std::sqrt(x * x + y * y + z * z) * (longest / std::fabs(p[3]));
  const auto times = [](float factor, double d) { return factor == 0 ? 0 : double(factor) * d; };
  const double sum = double(light.constant_attenuation) + times(light.linear_attenuation, distance) +
                     times(light.quadratic_attenuation, distance * distance);
  return float(1 / std::max(sum, 1e-15));
}

LightTerm make_term(const Light& light, bool local_viewer) {
  LightTerm term{};
  const auto& p = light.position;
  const Vector at{p[0] / p[3], p[1] / p[3], p[2] / p[3]};
  term.local = std::max({std::fabs(at.x), std::fabs(at.y), std::fabs(at.z)}) < kFarAway;
  if (term.local) {
    term.position[0] = at.x, term.position[1] = at.y, term.position[2] = at.z;
  } else {
    // The direction is that of P / w for a w however small.
    const double sign = p[3] < 0 ? -1 : 1;
    const Vector to_light = unit({sign * p[0], sign * p[1], sign * p[2]});
    store(to_light, term.direction);
    if (!local_viewer) store(unit({to_light.x, to_light.y, to_light.z + 1}), term.half);
    term.weight = far_attenuation(light);
  }
  term.attenuation[0] = light.constant_attenuation;
  term.attenuation[1] = light.linear_attenuation;
  term.attenuation[2] = light.quadratic_attenuation;
  term.attenuated = term.local && (light.constant_attenuation != 1 || light.linear_attenuation != 0 ||
                                   light.quadratic_attenuation != 0);
  term.spot = light.spot_cutoff != 180;
  const auto& s = light.spot_direction;
  store(unit({s[0], s[1], s[2]}), term.spot_direction);
  term.spot_cosine = float(light.spot_cosine);
  term.spot_exponent = light.spot_exponent;
  store(light.ambient, term.ambient);
  store(light.diffuse, term.diffuse);
  store(light.specular, term.specular);
  term.ambient_varies =
      (term.attenuated || term.spot || (!term.local && term.weight != 1)) && !is_black(light.ambient);
  return term;
}

MaterialTerms make_terms(const Material& material) {
  MaterialTerms terms;
  store(material.ambient, terms.ambient);
  store(material.diffuse, terms.diffuse);
  store(material.specular, terms.specular);
  store(material.emission, terms.emission);
  terms.shininess = material.shininess;
  return terms;
}

bool has_specular(const LightingState& state, std::span<const MaterialPair> materials) {
  const bool light = std::any_of(state.lights.begin(), state.lights.end(),
                                 [](const Light& l) { return l.enabled && !is_black(l.specular); });
  if (!light) return false;
  if (state.color_material_front.specular || state.color_material_back.specular) return true;
  const auto shines = [&](const MaterialPair& pair) {
    return !is_black(pair.front.specular) || (state.two_sided && !is_black(pair.back.specular));
  };
  return materials.empty() ? shines(state.material) : std::any_of(materials.begin(), materials.end(), shines);
}

}  // namespace

LightingJob make_lighting_job(const LightingState& state, std::span<const MaterialPair> materials) {
  LightingJob job{};
  job.local_viewer = state.local_viewer;
  job.two_sided = state.two_sided;
  job.specular = has_specular(state, materials);
  job.materials = materials.empty() ? nullptr : materials.data();
  job.material[0] = make_terms(state.material.front);
  job.material[1] = make_terms(state.material.back);
  job.tracked[0] = state.color_material_front;
  job.tracked[1] = state.color_material_back;
  job.tracks_color = job.tracked[0].any() || (job.two_sided && job.tracked[1].any());
  store(state.model_ambient, job.ambient);
  job.needs_eye = job.local_viewer && job.specular;
  for (const Light& light : state.lights) {
    if (!light.enabled) continue;
    LightTerm& term = job.lights[job.light_count++];
    term = make_term(light, state.local_viewer);
    job.needs_eye |= term.local;
    if (term.ambient_varies) continue;
    for (int k = 0; k < 3; ++k) job.ambient[k] += term.ambient[k];
  }
  return job;
}

}  // namespace halfspace::raster
