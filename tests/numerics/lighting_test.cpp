// Lighting and texture coordinate generation of the vertex stage against the spec's formulas in long double,
// against themselves on every instruction set, and through to the pixels.
#include "tests/oracle/lighting.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <iostream>
#include <type_traits>
#include <vector>

#include "raster/vertex/vertex_stage.h"
#include "tests/support/canvas.h"
#include "tests/support/random.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr uint32_t kVertices = 71;  // whole groups, and a rest that fills no vector

struct LitVertexInput {
  float position[4], color[4], normal[3], tex_coord[4];
};

struct Scenario {
  DrawState state;
  std::vector<LitVertexInput> vertices;
  std::vector<MaterialPair> materials;  // or none
  std::vector<uint32_t> material_index;

  VertexBatch batch() const {
    VertexBatch b;
    const LitVertexInput& v = vertices[0];
    b.position = {v.position, sizeof v, 4};
    b.color = {v.color, sizeof v, 4};
    b.normal = {v.normal, sizeof v, 3};
    b.tex_coord = {v.tex_coord, sizeof v, 4};
    if (!materials.empty()) b.material_index = material_index.data();
    b.count = uint32_t(vertices.size());
    return b;
  }
};

oracle::Real3 real3(const float* v) {
  return {static_cast<long double>(v[0]), static_cast<long double>(v[1]), static_cast<long double>(v[2])};
}
oracle::Real4 real4(const float* v) {
  const oracle::Real3 xyz = real3(v);
  return {xyz[0], xyz[1], xyz[2], static_cast<long double>(v[3])};
}

Color random_color(Random& r, float low = 0) {
  const auto c = [&] { return r.integer(0, 4) == 0 ? 0.0f : r.real(low, 1); };
  return {c(), c(), c(), r.real(0, 1)};
}

Light random_light(Random& r) {
  Light light;
  light.enabled = r.integer(0, 2) != 0;
  light.ambient = random_color(r), light.diffuse = random_color(r, -0.5f), light.specular = random_color(r);
  for (size_t k = 0; k < 3; ++k) light.position[k] = double(r.real(-5, 5));
  light.position[3] = r.integer(0, 1) ? 0 : double(r.real(0.25f, 2));
  if (r.integer(0, 1)) {
    light.spot_cutoff = r.real(20, 90);
    light.spot_cosine = std::cos(double(light.spot_cutoff) * 3.14159265358979323846 / 180);
    light.spot_exponent = r.integer(0, 1) ? r.real(0, 128) : 0.0f;
    for (size_t k = 0; k < 3; ++k) light.spot_direction[k] = double(r.real(-1, 1)) - light.position[k];
  }
  if (r.integer(0, 1)) {
    light.constant_attenuation = r.real(0.5f, 2);
    light.linear_attenuation = r.real(0, 0.5f);
    light.quadratic_attenuation = r.real(0, 0.1f);
  }
  return light;
}

Material random_material(Random& r) {
  return {random_color(r), random_color(r), r.integer(0, 2) ? random_color(r) : Color{0, 0, 0, 1},
          random_color(r, -0.2f), r.integer(0, 1) ? r.real(0, 128) : float(r.integer(0, 16))};
}

LightingState::ColorMaterial random_tracking(Random& r) {
  LightingState::ColorMaterial tracked;
  switch (r.integer(0, 5)) {
    case 0:
      tracked.ambient = true;
      break;
    case 1:
      tracked.diffuse = true;
      break;
    case 2:
      tracked.ambient = tracked.diffuse = true;
      break;
    case 3:
      tracked.specular = true;
      break;
    case 4:
      tracked.emission = true;
      break;
    default:
      break;
  }
  return tracked;
}

// A modelview without symmetry, its inverse transpose by cofactors, and a projection that keeps all inside.
void set_matrices(Random& r, DrawState& state) {
  auto& m = state.eye_from_object;
  for (size_t i = 0; i < 16; ++i) m[i] = double(r.real(-1, 1)) + (i % 5 == 0 ? 2 : 0);
  m[3] = m[7] = m[11] = 0, m[15] = 1;
  m[14] -= 4;
  const auto at = [&](size_t row, size_t column) { return m[4 * (column % 3) + row % 3]; };
  double det = 0;
  for (size_t c = 0; c < 3; ++c) {
    for (size_t row = 0; row < 3; ++row) {
      state.normal_from_object[3 * c + row] =
          at(row + 1, c + 1) * at(row + 2, c + 2) - at(row + 1, c + 2) * at(row + 2, c + 1);
    }
  }
  for (size_t row = 0; row < 3; ++row) det += at(row, 0) * state.normal_from_object[row];
  for (double& v : state.normal_from_object) v /= det;
  state.normalize = r.integer(0, 1);
  for (size_t k : {0u, 5u, 10u}) state.clip_from_object[k] = 0.125;
}

Scenario random_scenario(uint64_t seed) {
  Random r(seed);
  Scenario s;
  s.state = plain_state(64, 64);
  set_matrices(r, s.state);
  LightingState& lighting = s.state.lighting;
  lighting.enabled = true;
  lighting.local_viewer = r.integer(0, 1);
  lighting.two_sided = r.integer(0, 1);
  lighting.model_ambient = random_color(r);
  const int64_t lights = r.integer(0, 8);
  for (int64_t i = 0; i < lights; ++i) lighting.lights[size_t(i)] = random_light(r);
  lighting.material = {random_material(r), random_material(r)};
  if (r.integer(0, 1)) {
    lighting.color_material_front = random_tracking(r);
    lighting.color_material_back = random_tracking(r);
  }
  s.vertices.resize(kVertices);
  for (LitVertexInput& v : s.vertices) {
    for (int k = 0; k < 3; ++k) {
      v.position[k] = r.real(-2, 2);
      v.normal[k] = r.real(-1, 1);
      v.tex_coord[k] = r.real(-3, 3);
      v.color[k] = r.real(0, 1);
    }
    v.position[3] = r.integer(0, 3) ? 1 : r.real(0.5f, 2);
    v.color[3] = r.real(0, 1);
    v.tex_coord[3] = 1;
    // Of length 1 in eye coordinates, as applications have them.
    const oracle::Real3 n = oracle::eye_normal(s.state, real3(v.normal));
    const float length = float(std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
    for (float& c : v.normal) c /= length;
  }
  if (r.integer(0, 2) == 0) {
    for (int i = 0; i < 5; ++i) s.materials.push_back({random_material(r), random_material(r)});
    for (uint32_t i = 0; i < kVertices; ++i) s.material_index.push_back(uint32_t(r.integer(0, 4)));
  }
  return s;
}

struct Shaded {
  ShadedVertices out;
  std::vector<uint64_t> storage;
};

Shaded shade(const Scenario& s) {
  Shaded result;
  const VertexBatch batch = s.batch();
  result.out.layout = choose_layout(s.state, batch);
  result.out.count = batch.count;
  result.storage.assign(result.out.layout.stride() / 8 * batch.count, 0);
  result.out.records = reinterpret_cast<std::byte*>(result.storage.data());
  result.out.outcodes.resize(batch.count);
  shade_vertices(s.state, batch, s.materials, 0, batch.count, result.out);
  return result;
}

void track(const LightingState::ColorMaterial& tracked, const float* c, Material& m) {
  const Color color{c[0], c[1], c[2], c[3]};
  if (tracked.ambient) m.ambient = color;
  if (tracked.diffuse) m.diffuse = color;
  if (tracked.specular) m.specular = color;
  if (tracked.emission) m.emission = color;
}

oracle::LitVertex truth(const Scenario& s, uint32_t i) {
  const LitVertexInput& v = s.vertices[i];
  MaterialPair pair = s.materials.empty() ? s.state.lighting.material : s.materials[s.material_index[i]];
  track(s.state.lighting.color_material_front, v.color, pair.front);
  track(s.state.lighting.color_material_back, v.color, pair.back);
  return oracle::light_vertex(s.state, pair, real4(v.position), real3(v.normal));
}

long double worst_of(const oracle::Real4& expected, const float* got) {
  long double worst = 0;
  for (size_t k = 0; k < 4; ++k)
    worst = std::max(worst, std::fabs(expected[k] - static_cast<long double>(got[k])));
  return worst;
}

// A hundredth of a level of 255: rounding to bytes then shows it on one pixel in fifty at most.
constexpr long double kLightingTolerance = 0.01L / 255;

TEST(Lighting, IsTheSpecsFormula) {
  const uint64_t seeds = long_tests() ? 20000 : 1000;
  long double worst = 0;
  size_t compared = 0, lit = 0;
  for (uint64_t seed = 0; seed < seeds; ++seed) {
    const Scenario s = random_scenario(seed);
    const Shaded shaded = shade(s);
    const VertexLayout& layout = shaded.out.layout;
    for (uint32_t i = 0; i < kVertices; ++i) {
      const oracle::LitVertex expected = truth(s, i);
      if (expected.margin < 1e-5L) continue;  // there the formula jumps
      const Color& c = layout.constant_color;
      const float constant[4] = {c.r, c.g, c.b, c.a};
      const float* attributes = shaded.out.attributes(i);
      const float* front = layout.color < 0 ? constant : attributes + layout.color;
      long double error = worst_of(expected.front, front);
      if (layout.back_color >= 0)
        error = std::max(error, worst_of(expected.back, attributes + layout.back_color));
      ASSERT_LE(error, kLightingTolerance) << "seed " << seed << ", vertex " << i;
      worst = std::max(worst, error);
      ++compared;
      lit += expected.front[0] > 0 && expected.front[0] < 1;
    }
    EXPECT_EQ(layout.back_color >= 0, s.state.lighting.two_sided && layout.color >= 0);
  }
  std::cout << "largest error " << double(worst * 255) << " levels of 255 in " << compared << " vertices\n";
  EXPECT_GT(compared, seeds * kVertices * 9 / 10);
  EXPECT_GT(lit, compared / 3);
}

// At the exact level a vertex keeps what a float loses.
TEST(Lighting, ExactIsTheSpecsFormulaInDouble) {
  const uint64_t seeds = long_tests() ? 5000 : 300;
  size_t compared = 0;
  for (uint64_t seed = 0; seed < seeds; ++seed) {
    Scenario s = random_scenario(seed);
    s.state.accuracy = Accuracy::all(Level::exact);
    const Shaded shaded = shade(s);
    const VertexLayout& layout = shaded.out.layout;
    for (uint32_t i = 0; i < kVertices; ++i) {
      const oracle::LitVertex expected = truth(s, i);
      if (expected.margin < 1e-5L) continue;
      const Color& c = layout.constant_color;
      const float constant[4] = {c.r, c.g, c.b, c.a};
      for (int k = 0; k < 4; ++k) {
        const auto front = (long double)(layout.color < 0 ? double(constant[k]) : shaded.out.attribute(i, layout.color + k));
        // A colour that no vertex changes is a float.
        ASSERT_NEAR(double(front - expected.front[size_t(k)]), 0, layout.color < 0 ? 0x1p-24 : 1e-11) << seed << ", " << i;
        if (layout.back_color < 0) continue;
        const auto back = (long double)(shaded.out.attribute(i, layout.back_color + k));
        ASSERT_NEAR(double(back - expected.back[size_t(k)]), 0, 1e-11) << seed << ", " << i;
      }
      compared += layout.color >= 0;
    }
  }
  EXPECT_GT(compared, seeds * kVertices / 2);
}

// However far a light is: with w = 0 it is not attenuated, with any other w it is.
TEST(Lighting, FarLightsAreAttenuated) {
  size_t lit = 0;
  for (const double far : {1e6, 1e12, 1e14, 1e16, 1e25, 1e37, 1e120}) {
    for (uint64_t seed = 0; seed < 100; ++seed) {
      Scenario s = random_scenario(seed);
      Random r(seed);
      for (Light& light : s.state.lighting.lights) {
        auto& p = light.position;
        if (r.integer(0, 1) && far < 1e100) {
          for (size_t k = 0; k < 3; ++k) p[k] *= far;
        } else {
          p[3] /= far;  // P / w
        }
        // So that it still shows.
        light.linear_attenuation = float(double(light.linear_attenuation) / far);
        light.quadratic_attenuation = float(double(light.quadratic_attenuation) / far / far);
      }
      const Shaded shaded = shade(s);
      for (uint32_t i = 0; i < kVertices; ++i) {
        const oracle::LitVertex expected = truth(s, i);
        if (expected.margin < 1e-5L || shaded.out.layout.color < 0) continue;
        const float* front = shaded.out.attributes(i) + shaded.out.layout.color;
        ASSERT_LE(worst_of(expected.front, front), kLightingTolerance)
            << far << ": seed " << seed << ", vertex " << i;
        lit += expected.front[0] > 0 && expected.front[0] < 1;
      }
    }
  }
  EXPECT_GT(lit, 10000u);
}

// One vertex alone is that vertex of many: where it stands in a vector or a group changes nothing.
TEST(Lighting, AVertexAloneIsTheSame) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const Scenario all = random_scenario(seed);
    const Shaded together = shade(all);
    for (uint32_t i = 0; i < kVertices; i += 7) {
      const VertexLayout& layout = together.out.layout;
      if (layout.color < 0) continue;
      ShadedVertices one;
      one.layout = layout;
      std::vector<uint64_t> storage(layout.stride() / 8);
      one.records = reinterpret_cast<std::byte*>(storage.data());
      one.count = 1;
      one.outcodes.resize(1);
      Scenario alone = all;
      alone.vertices = {all.vertices[i]};
      if (!all.materials.empty()) alone.material_index = {all.material_index[i]};
      shade_vertices(alone.state, alone.batch(), alone.materials, 0, 1, one);
      EXPECT_EQ(std::memcmp(one.attributes(0), together.out.attributes(i), size_t(layout.float_count()) * 4),
                0)
          << "seed " << seed << ", vertex " << i;
    }
  }
}

TEST(Lighting, EveryInstructionSetAgrees) {
  for (uint64_t seed = 0; seed < 300; ++seed) {
    const Scenario s = random_scenario(seed);
    const Shaded reference = [&] {
      const IsaScope scope("scalar");
      return shade(s);
    }();
    for (const std::string& isa : isa_levels()) {
      const IsaScope scope(isa);
      const Shaded shaded = shade(s);
      EXPECT_EQ(shaded.storage, reference.storage) << "seed " << seed << " on " << isa;
      EXPECT_EQ(shaded.out.layout.constant_color, reference.out.layout.constant_color)
          << seed << " on " << isa;
    }
  }
}

// Whatever comes in: colours in [0, 1], the same everywhere.
TEST(Lighting, BadInputStaysInRange) {
  const float bad[] = {0, -0.0f, 1e-40f, 1e-25f, 1e20f, 3e38f, -3e38f, INFINITY, -INFINITY, NAN, 1};
  for (uint64_t seed = 0; seed < 400; ++seed) {
    Scenario s = random_scenario(seed);
    Random r(seed + 5000);
    const auto spoil = [&](auto& v) {
      if (r.integer(0, 3) == 0) v = std::decay_t<decltype(v)>(bad[r.integer(0, 10)]);
    };
    for (LitVertexInput& v : s.vertices) {
      for (float& f : v.normal) spoil(f);
      for (float& f : v.position) spoil(f);
    }
    Light& light = s.state.lighting.lights[0];
    light.enabled = true;
    for (double& f : light.position) spoil(f);
    for (double& f : light.spot_direction) spoil(f);
    for (double& f : s.state.normal_from_object) spoil(f);
    light.constant_attenuation = 0;
    light.linear_attenuation = 0;
    light.quadratic_attenuation = 0;
    const Shaded reference = [&] {
      const IsaScope scope("scalar");
      return shade(s);
    }();
    const VertexLayout& layout = reference.out.layout;
    for (uint32_t i = 0; layout.color >= 0 && i < kVertices; ++i) {
      const float* c = reference.out.attributes(i) + layout.color;
      for (int k = 0; k < 4; ++k) EXPECT_TRUE(c[k] >= 0 && c[k] <= 1) << seed << ' ' << i << ' ' << c[k];
    }
    for (const std::string& isa : isa_levels()) {
      const IsaScope scope(isa);
      const Shaded shaded = shade(s);
      for (uint32_t i = 0; layout.color >= 0 && i < kVertices; ++i) {
        EXPECT_EQ(std::memcmp(shaded.out.attributes(i), reference.out.attributes(i),
                              size_t(layout.float_count()) * 4),
                  0)
            << "seed " << seed << " vertex " << i << " on " << isa;
      }
    }
  }
}

// A light where the vertex is gives its ambient part and nothing else; a zero normal no diffuse one.
TEST(Lighting, NothingToDivideByIsDefined) {
  Scenario s;
  s.state = plain_state(8, 8);
  s.state.normalize = true;
  LightingState& lighting = s.state.lighting;
  lighting.enabled = true;
  lighting.model_ambient = {0, 0, 0, 1};
  lighting.material.front = {{1, 1, 1, 1}, {1, 1, 1, 0.5f}, {1, 1, 1, 1}, {0, 0, 0, 1}, 0};
  Light& light = lighting.lights[0];
  light.enabled = true;
  light.ambient = {0.25f, 0.5f, 0.75f, 1}, light.diffuse = light.specular = {1, 1, 1, 1};
  light.position = {0.5, 0.25, 0, 1};
  s.vertices = {{{0.5f, 0.25f, 0, 1}, {}, {0, 0, 1}, {}}, {{0, 0, 0, 1}, {}, {0, 0, 0}, {}}};
  const Shaded shaded = shade(s);
  for (uint32_t i = 0; i < 2; ++i) {
    const float* c = shaded.out.attributes(i) + shaded.out.layout.color;
    EXPECT_EQ((std::array{c[0], c[1], c[2], c[3]}), (std::array{0.25f, 0.5f, 0.75f, 0.5f})) << i;
  }
}

TEST(TexGen, IsTheSpecsFormula) {
  long double worst = 0;
  for (uint64_t seed = 0; seed < 1000; ++seed) {
    Scenario s = random_scenario(seed);
    Random r(seed + 9000);
    s.state.lighting.enabled = r.integer(0, 1);
    s.state.texture.view = std::make_shared<TextureView>();
    for (size_t k = 0; k < 4; ++k) {
      TexGenCoord& coord = s.state.tex_gen.coord[k];
      coord.mode = TexGenMode(r.integer(0, k < 2 ? 3 : 2));
      for (double& p : coord.object_plane) p = double(r.real(-2, 2));
      for (double& p : coord.eye_plane) p = double(r.real(-2, 2));
    }
    const Shaded shaded = shade(s);
    const VertexLayout& layout = shaded.out.layout;
    for (uint32_t i = 0; i < kVertices; ++i) {
      const LitVertexInput& v = s.vertices[i];
      const oracle::Real4 expected =
          oracle::generate(s.state, real4(v.position), real3(v.normal), real4(v.tex_coord));
      const float* got = shaded.out.attributes(i) + layout.tex_coord;
      // Relative to the terms of the sum, which are below 20.
      long double error = std::max(std::fabs(expected[0] - static_cast<long double>(got[0])),
                                   std::fabs(expected[1] - static_cast<long double>(got[1])));
      if (layout.projective)
        error = std::max(error, std::fabs(expected[3] - static_cast<long double>(got[2])));
      worst = std::max(worst, error);
      ASSERT_LE(error, 2e-5L) << "seed " << seed << ", vertex " << i;
    }
    EXPECT_EQ(layout.projective, s.state.tex_gen.coord[3].mode != TexGenMode::off);
    for (const std::string& isa : isa_levels()) {
      const IsaScope scope(isa);
      EXPECT_EQ(shade(s).storage, shaded.storage) << seed << " on " << isa;
    }
  }
  std::cout << "largest error " << double(worst) << "\n";
}

// Which of the two colours a polygon has, whole or cut, smooth or flat: its own face's.
TEST(Lighting, PolygonsTakeTheirFacesColour) {
  constexpr int kSize = 64;
  for (bool cut : {false, true}) {
    for (bool flat : {false, true}) {
      for (bool back : {false, true}) {
        for (bool front_is_ccw : {false, true}) {
          DrawState state = plain_state(kSize, kSize);
          state.raster.flat_shading = flat;
          state.raster.front_is_ccw = front_is_ccw;
          state.lighting.enabled = state.lighting.two_sided = true;
          state.lighting.model_ambient = {0, 0, 0, 1};
          // Emission of the front, red; of the back what the vertices' colours say.
          state.lighting.material.front.emission = {1, 0, 0, 1};
          state.lighting.color_material_back.emission = true;
          state.lighting.material.back.emission = {0, 0, 0, 1};
          const float far = cut ? 3 : 1;
          std::vector<Vertex> v{
              {-1, -1, 0, 1, {0, 1, 0, 1}}, {1, -1, 0, 1, {0, 1, 0, 1}}, {1, 1, far, 1, {0, 0.5f, 1, 1}}};
          if (back == front_is_ccw) std::swap(v[0], v[1]);
          Canvas canvas(kSize, kSize);
          canvas.clear();
          canvas.draw(state, Primitive::triangles, v);
          const Picture picture = canvas.read();
          const uint8_t* p = picture.pixel(40, 2);
          const std::array<int, 3> got{p[0], p[1], p[2]};
          if (!back) {
            EXPECT_EQ(got, (std::array{255, 0, 0})) << cut << flat;
          } else if (flat) {
            EXPECT_EQ(got, (std::array{0, 128, 255})) << cut << flat;
          } else {
            // At pixel (40, 2) the third corner's weight is 2.5 / 64.
            const double w = 2.5 / 64;
            EXPECT_EQ(got, (std::array{0, int(std::lround(255 * (1 - w / 2))), int(std::lround(255 * w))}))
                << cut;
          }
        }
      }
    }
  }
}

// Drawn as points or lines, a polygon still has its own face's colour; lines and points of their own have the
// front's.
TEST(Lighting, OutlinesTakeTheirPolygonsColour) {
  constexpr int kSize = 64;
  for (PolygonMode mode : {PolygonMode::fill, PolygonMode::line, PolygonMode::point}) {
    for (bool cut : {false, true}) {
      for (bool flat : {false, true}) {
        for (int kind = 0; kind < 4; ++kind) {  // front, back, line, point
          DrawState state = plain_state(kSize, kSize);
          state.polygon.front = state.polygon.back = mode;
          state.raster.flat_shading = flat;
          state.lighting.enabled = state.lighting.two_sided = true;
          state.lighting.model_ambient = {0, 0, 0, 1};
          state.lighting.material.front.emission = {1, 0, 0, 1};
          state.lighting.material.back.emission = {0, 1, 0, 1};
          const float far = cut ? 3 : 0;
          std::vector<Vertex> v{{-0.75f, -0.75f}, {0.75f, -0.5f}, {0.25f, 0.75f, far}};
          if (kind == 1) std::swap(v[0], v[1]);
          Canvas canvas(kSize, kSize);
          canvas.clear();
          canvas.draw(state,
                      kind < 2    ? Primitive::triangles
                      : kind == 2 ? Primitive::lines
                                  : Primitive::points,
                      v);
          const Picture picture = canvas.read();
          size_t drawn = 0;
          for (int i = 0; i < kSize * kSize; ++i) {
            const uint8_t* p = picture.pixel(i % kSize, i / kSize);
            if (!p[0] && !p[1]) continue;
            ++drawn;
            EXPECT_EQ((std::array<int, 2>{p[0], p[1]}),
                      (kind == 1 ? std::array{0, 255} : std::array{255, 0}));
          }
          EXPECT_GT(drawn, 1u) << int(mode) << cut << flat << kind;
        }
      }
    }
  }
}

// Colours that the material takes over, as bytes and as the floats they stand for.
TEST(Lighting, BytesAreTheColoursTheyStandFor) {
  constexpr int kSize = 64;
  const std::array<std::array<uint8_t, 4>, 3> bytes{{{255, 17, 80, 255}, {3, 200, 129, 60}, {90, 1, 254, 128}}};
  for (const Level level : {Level::standard, Level::exact}) {
    DrawState state = plain_state(kSize, kSize);
    state.accuracy.transform = level;
    state.lighting.enabled = true;
    state.lighting.lights[0].enabled = true;
    state.lighting.lights[0].diffuse = {1, 0.75f, 0.5f, 1};
    state.lighting.color_material_front.diffuse = true;
    std::array<Vertex, 3> corners{{{-1, -1}, {1, -1}, {0, 1}}};
    for (size_t i = 0; i < 3; ++i) {
      const auto channel = [&](size_t k) { return static_cast<float>(bytes[i][k]) / 255.0f; };
      corners[i].color = {channel(0), channel(1), channel(2), channel(3)};
    }
    Canvas as_floats(kSize, kSize), as_bytes(kSize, kSize);
    as_floats.draw(state, Primitive::triangles, corners);
    DrawPacket packet;
    packet.state = std::make_shared<DrawState>(state);
    packet.index_count = packet.batch.count = 3;
    packet.batch.position = {&corners[0].x, sizeof(Vertex), 4};
    packet.batch.color = {bytes.data(), sizeof bytes[0], 4, true};
    as_bytes.device().draw(packet);
    const Picture picture = as_bytes.read();
    EXPECT_EQ(first_difference(as_floats.read(), picture), "") << "level " << int(level);
    EXPECT_GT(picture.pixel(kSize / 2, kSize / 2)[0], 0);
  }
}

}  // namespace
}  // namespace halfspace::test
