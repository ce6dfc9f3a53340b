#include "ref_app/teapot.h"

#include <array>
#include <glm/geometric.hpp>

#include "ref_app/noise.h"

namespace ref_app {
namespace {

// Newell's 306 control points follow from 42 by the teapot's symmetries: lid, rim, body and bottom are
// profiles (radius, height) turned about the axis in four quarters; handle and spout are one side, mirrored.
// z is up here, as in his data.
using Profile = std::array<glm::dvec2, 4>;
using Patch = std::array<std::array<glm::dvec3, 4>, 4>;  // [along the profile or the tube][around it]

constexpr std::array<Profile, 6> kProfiles{{
    {{{0.0, 3.15}, {0.8, 3.15}, {0.0, 2.85}, {0.2, 2.7}}},             // knob of the lid
    {{{0.2, 2.7}, {0.4, 2.55}, {1.3, 2.55}, {1.3, 2.4}}},              // lid
    {{{1.4, 2.4}, {1.3375, 2.53125}, {1.4375, 2.53125}, {1.5, 2.4}}},  // rim
    {{{1.5, 2.4}, {1.75, 1.875}, {2.0, 1.35}, {2.0, 0.9}}},            // upper body
    {{{2.0, 0.9}, {2.0, 0.45}, {1.5, 0.225}, {1.5, 0.15}}},            // lower body
    {{{1.5, 0.15}, {1.5, 0.075}, {1.425, 0.0}, {0.0, 0.0}}},           // bottom
}};

// Cross-sections from the inside of the bend, at y = 0, round the side y < 0 to the outside.
constexpr std::array<Patch, 4> kTubes{{
    {{{{{-1.6, 0, 2.025}, {-1.6, -0.3, 2.025}, {-1.5, -0.3, 2.25}, {-1.5, 0, 2.25}}},  // upper handle
      {{{-2.3, 0, 2.025}, {-2.3, -0.3, 2.025}, {-2.5, -0.3, 2.25}, {-2.5, 0, 2.25}}},
      {{{-2.7, 0, 2.025}, {-2.7, -0.3, 2.025}, {-3.0, -0.3, 2.25}, {-3.0, 0, 2.25}}},
      {{{-2.7, 0, 1.8}, {-2.7, -0.3, 1.8}, {-3.0, -0.3, 1.8}, {-3.0, 0, 1.8}}}}},
    {{{{{-2.7, 0, 1.8}, {-2.7, -0.3, 1.8}, {-3.0, -0.3, 1.8}, {-3.0, 0, 1.8}}},  // lower handle
      {{{-2.7, 0, 1.575}, {-2.7, -0.3, 1.575}, {-3.0, -0.3, 1.35}, {-3.0, 0, 1.35}}},
      {{{-2.5, 0, 1.125}, {-2.5, -0.3, 1.125}, {-2.65, -0.3, 0.9375}, {-2.65, 0, 0.9375}}},
      {{{-2.0, 0, 0.9}, {-2.0, -0.3, 0.9}, {-1.9, -0.3, 0.6}, {-1.9, 0, 0.6}}}}},
    {{{{{1.7, 0, 1.425}, {1.7, -0.66, 1.425}, {1.7, -0.66, 0.6}, {1.7, 0, 0.6}}},  // lower spout
      {{{2.6, 0, 1.425}, {2.6, -0.66, 1.425}, {3.1, -0.66, 0.825}, {3.1, 0, 0.825}}},
      {{{2.3, 0, 2.1}, {2.3, -0.25, 2.1}, {2.4, -0.25, 2.025}, {2.4, 0, 2.025}}},
      {{{2.7, 0, 2.4}, {2.7, -0.25, 2.4}, {3.3, -0.25, 2.4}, {3.3, 0, 2.4}}}}},
    {{{{{2.7, 0, 2.4}, {2.7, -0.25, 2.4}, {3.3, -0.25, 2.4}, {3.3, 0, 2.4}}},  // upper spout, and its lip
      {{{2.8, 0, 2.475}, {2.8, -0.25, 2.475}, {3.525, -0.25, 2.49375}, {3.525, 0, 2.49375}}},
      {{{2.9, 0, 2.475}, {2.9, -0.15, 2.475}, {3.45, -0.15, 2.5125}, {3.45, 0, 2.5125}}},
      {{{2.8, 0, 2.4}, {2.8, -0.15, 2.4}, {3.2, -0.15, 2.4}, {3.2, 0, 2.4}}}}},
}};

constexpr int kDivisions = 8;

// Newell's quarter circles: handles of 0.56 of the radius, save the knob's widest ring.
Patch turn(const Profile& profile, int quarter) {
  Patch patch;
  for (size_t i = 0; i < 4; ++i) {
    const double r = profile[i].x, z = profile[i].y, bow = r == 0.8 ? 0.45 : 0.56 * r;
    const std::array<glm::dvec2, 4> arc{{{r, 0}, {r, -bow}, {bow, -r}, {0, -r}}};
    for (size_t j = 0; j < 4; ++j) {
      glm::dvec2 p = arc[j];
      for (int turned = 0; turned < quarter; ++turned) p = {p.y, -p.x};
      patch[i][j] = {p, z};
    }
  }
  return patch;
}

Patch mirror(const Patch& side) {
  Patch patch = side;
  for (auto& section : patch) {
    for (glm::dvec3& p : section) p.y = -p.y;
  }
  return patch;
}

// Bernstein polynomials of degree 3 and their derivatives at t.
struct Basis {
  std::array<double, 4> value, slope;
};
Basis basis_at(double t) {
  const double s = 1 - t;
  return {{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t},
          {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t}};
}

glm::dvec3 combine(const Patch& patch, const std::array<double, 4>& along,
                   const std::array<double, 4>& around) {
  glm::dvec3 sum(0);
  for (size_t i = 0; i < 4; ++i) {
    for (size_t j = 0; j < 4; ++j) sum += along[i] * around[j] * patch[i][j];
  }
  return sum;
}

// Outward normal. In the poles of lid and bottom all of a ring is one point: there we look just beside it.
glm::dvec3 normal_at(const Patch& patch, double along, double around, double side) {
  for (const double nudge : {0.0, 1e-3}) {
    const Basis a = basis_at(along < 0.5 ? along + nudge : along - nudge), b = basis_at(around);
    const glm::dvec3 n =
        side * glm::cross(combine(patch, a.value, b.slope), combine(patch, a.slope, b.value));
    const double length = glm::length(n);
    if (length > 1e-9) return n / length;
  }
  return {0, 0, 1};
}

// Newell's z is the scenes' y.
glm::vec3 y_up(const glm::dvec3& p) { return {p.x, p.z, -p.y}; }

void add_patch(Geometry& mesh, const Patch& patch, double side, const TeapotLook& look) {
  const auto base = static_cast<uint32_t>(mesh.vertices.size());
  for (int i = 0; i <= kDivisions; ++i) {
    for (int j = 0; j <= kDivisions; ++j) {
      const double along = static_cast<double>(i) / kDivisions, around = static_cast<double>(j) / kDivisions;
      const glm::dvec3 point = combine(patch, basis_at(along).value, basis_at(around).value);
      const glm::vec3 normal = y_up(normal_at(patch, along, around, side));
      mesh.vertices.push_back({{y_up(point), 1.0F}, {baked_color(look, normal), 1.0F}, {around, 1 - along}});
    }
  }
  constexpr uint32_t kRow = kDivisions + 1;
  for (uint32_t i = 0; i < kDivisions; ++i) {
    for (uint32_t j = 0; j < kDivisions; ++j) {
      const uint32_t k = base + i * kRow + j;
      for (const uint32_t corner : {k, k + kRow, k + kRow + 1, k, k + kRow + 1, k + 1})
        mesh.indices.push_back(corner);
    }
  }
}

}  // namespace

glm::vec3 baked_color(const TeapotLook& look, const glm::vec3& normal) {
  // Half-Lambert: the side away from the light keeps its form.
  const float wrapped = 0.5F + 0.5F * glm::dot(normal, look.light);
  const float diffuse = 0.22F + 0.78F * wrapped * wrapped;
  float shine = glm::dot(normal, glm::normalize(look.light + look.eye));
  shine = shine < 0 ? 0 : shine;
  for (int squaring = 0; squaring < 5; ++squaring) shine *= shine;  // the 32nd power
  return glm::clamp(look.color * diffuse + glm::vec3(0.55F * shine), 0.0F, 1.0F);
}

Geometry make_teapot(const TeapotLook& look) {
  Geometry mesh;
  mesh.vertices.reserve(size_t{32} * (kDivisions + 1) * (kDivisions + 1));
  mesh.indices.reserve(size_t{kTeapotTriangles} * 3);
  for (const Profile& profile : kProfiles) {
    for (int quarter = 0; quarter < 4; ++quarter) add_patch(mesh, turn(profile, quarter), 1.0, look);
  }
  for (const Patch& side : kTubes) {
    add_patch(mesh, side, 1.0, look);
    add_patch(mesh, mirror(side), -1.0, look);
  }
  return mesh;
}

}  // namespace ref_app
