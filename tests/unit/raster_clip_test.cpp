// Clipping against a model: a point of the window lies in the cut triangle when the ray through it meets the
// whole triangle in front of the eye, between near and far. Long double, by Cramer's rule, point by point.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <random>

#include "tests/unit/raster_front.h"

namespace halfspace::raster {
namespace {

using Real = long double;
using test::Front;

struct Ray {
  bool hit = false;     // inside the triangle and the volume
  bool margin = false;  // so near an edge of either that snapping may decide otherwise
  Real z = 0, inv_w = 0, s_over_w = 0;
};

Real det3(const std::array<std::array<Real, 3>, 3>& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// Weights b with sum b_i (x_i, y_i, w_i) = (nx, ny, 1): the point of the triangle seen at NDC (nx, ny), over
// w.
bool weights(const ClipVertex (&corners)[3], Real nx, Real ny, Real (&b)[3]) {
  std::array<std::array<Real, 3>, 3> m;
  for (size_t i = 0; i < 3; ++i)
    m[0][i] = Real(corners[i].x), m[1][i] = Real(corners[i].y), m[2][i] = Real(corners[i].w);
  const Real det = det3(m);
  if (det == 0) return false;
  const Real point[3] = {nx, ny, 1};
  for (size_t i = 0; i < 3; ++i) {
    auto replaced = m;
    for (size_t r = 0; r < 3; ++r) replaced[r][i] = point[r];
    b[i] = det3(replaced) / det;
  }
  return true;
}

Ray cast(const Front& f, Real px, Real py) {
  const Viewport& v = f.state->viewport;
  const Real nx = (px - v.x) * 2 / v.width - 1, ny = (py - v.y) * 2 / v.height - 1;
  Ray ray;
  Real b[3];
  const ClipPositions& clip = f.record.vertices.clip;
  if (!weights({clip[0], clip[1], clip[2]}, nx, ny, b)) return ray;
  Real z_over_w = 0;
  ray.hit = true;
  for (uint32_t i = 0; i < 3; ++i) {
    ray.inv_w += b[i];
    z_over_w += b[i] * Real(clip[i].z);
    ray.s_over_w += b[i] * Real(f.record.vertices.attributes(i)[0]);
    ray.hit = ray.hit && b[i] >= 0;
  }
  ray.hit = ray.hit && ray.inv_w > 0 && z_over_w >= -1 && z_over_w <= 1;
  ray.z = (z_over_w + 1) / 2;
  return ray;
}

// The ray, with `margin` set when a twentieth of a pixel changes the answer.
Ray cast_with_margin(const Front& f, int px, int py) {
  Ray ray = cast(f, px + Real(0.5), py + Real(0.5));
  for (int k = 0; k < 8; ++k) {
    const int dx = (k * 2 + 1) % 3 - 1, dy = k / 3 - 1;
    const Ray other = cast(f, px + Real(0.5) + dx * Real(0.05), py + Real(0.5) + dy * Real(0.05));
    ray.margin = ray.margin || other.hit != ray.hit;
  }
  return ray;
}

int times_covered(const Front& f, int px, int py, const PlaneSource** planes = nullptr) {
  int times = 0;
  for (const PrimitiveRef& ref : f.segment.primitives) {
    int32_t x[3], y[3];
    f.corners(ref, x, y);
    if (!test::covers(x, y, px, py)) continue;
    ++times;
    if (planes && ref.cut) *planes = &f.segment.plane_sources[f.segment.cut_triangles[ref.v[0]].source];
  }
  return times;
}

Real evaluate(const PlaneSource& p, int k, int px, int py) {
  const Plane& plane = p.planes[k];
  const Real dx = px + Real(0.5) - Real(p.x0) / 256, dy = py + Real(0.5) - Real(p.y0) / 256;
  return Real(plane.f0) + Real(plane.dfdx) * dx + Real(plane.dfdy) * dy;
}

// Settled planes of depth are in steps of the depth buffer, and half a step higher.
constexpr double kSteps = double(kDepthMax);
template <class T>
T depth_of(T steps) {
  return (steps - T(0.5)) / T(kSteps);
}

void expect_planes(const PlaneSource& p, const Ray& ray, int px, int py) {
  EXPECT_NEAR(double(depth_of(evaluate(p, 0, px, py))), double(ray.z), 1e-9);
  EXPECT_NEAR(double(evaluate(p, 1, px, py) / ray.inv_w), 1, 1e-7);
  EXPECT_NEAR(double(evaluate(p, 2, px, py)), double(ray.s_over_w),
              1e-9 * (1 + std::fabs(double(ray.inv_w)) * 100));
}

// A triangle at random in clip coordinates, `reach` times the volume.
Front random_triangle(std::mt19937& rng, float reach) {
  Front f(64, 48);
  std::uniform_real_distribution<float> d(-1, 1);
  for (int i = 0; i < 3; ++i) {
    const float w = d(rng) * 2;
    f.add(d(rng) * reach, d(rng) * reach, d(rng) * 3, w);
    f.tex_coords.insert(f.tex_coords.end(), {d(rng) * 10, d(rng) * 10});
  }
  return f;
}

TEST(Clip, CutTrianglesCoverWhatRaysMeet) {
  std::mt19937 rng(1);
  int cut = 0, compared = 0;
  for (int n = 0; n < 400; ++n) {
    Front f = random_triangle(rng, n % 2 ? 2.0f : 2000.0f);
    f.run(Primitive::triangles);
    cut += f.segment.clipped > 0;
    for (int i = 0; i < 64 * 48; i += 7) {
      const int px = i % 64, py = i / 64;
      const Ray ray = cast_with_margin(f, px, py);
      if (ray.margin) continue;
      const PlaneSource* planes = nullptr;
      ASSERT_EQ(times_covered(f, px, py, &planes), ray.hit ? 1 : 0) << n << ": " << px << "," << py;
      if (planes) expect_planes(*planes, ray, px, py), ++compared;
    }
  }
  EXPECT_GT(cut, 150);
  EXPECT_GT(compared, 1000);
}

TEST(Clip, DepthRangeScalesTheDepthPlane) {
  std::mt19937 rng(8);
  for (int n = 0; n < 50; ++n) {
    Front f = random_triangle(rng, 2);
    f.run(Primitive::triangles);
    if (f.segment.plane_sources.empty()) continue;
    const Plane before = f.segment.plane_sources[0].planes[0];
    f.state->viewport.depth_near = 0.75, f.state->viewport.depth_far = 0.25;
    f.run(Primitive::triangles);
    const Plane after = f.segment.plane_sources[0].planes[0];
    const double depth = depth_of(before.f0), slope = before.dfdx / kSteps;
    EXPECT_NEAR(depth_of(after.f0), 0.75 - 0.5 * depth, 1e-12 * (1 + std::fabs(depth)));
    EXPECT_NEAR(after.dfdx / kSteps, -0.5 * slope, 1e-12 * (1 + std::fabs(slope)));
  }
}

// What one vertex order gives, in a form another order must give too.
struct Cut {
  std::vector<std::array<int32_t, 6>> triangles;
  std::vector<std::array<double, 9>> planes;
  bool operator==(const Cut&) const = default;
};
Cut cut_of(const Front& f) {
  Cut cut;
  for (const CutTriangle& t : f.segment.cut_triangles) {
    std::array<std::array<int32_t, 2>, 3> corners;
    for (size_t i = 0; i < 3; ++i) corners[i] = {t.x[i], t.y[i]};
    std::sort(corners.begin(), corners.end());
    cut.triangles.push_back(
        {corners[0][0], corners[0][1], corners[1][0], corners[1][1], corners[2][0], corners[2][1]});
  }
  std::sort(cut.triangles.begin(), cut.triangles.end());
  for (const PlaneSource& s : f.segment.plane_sources) {
    cut.planes.push_back({});
    for (size_t k = 0; k < 3; ++k) {
      cut.planes.back()[3 * k] = s.planes[k].f0;
      cut.planes.back()[3 * k + 1] = s.planes[k].dfdx;
      cut.planes.back()[3 * k + 2] = s.planes[k].dfdy;
    }
  }
  std::sort(cut.planes.begin(), cut.planes.end());
  return cut;
}

TEST(Clip, VertexOrderChangesNoBit) {
  std::mt19937 rng(2);
  for (int n = 0; n < 1000; ++n) {
    Front f = random_triangle(rng, n % 3 ? 2.0f : 1000.0f);
    f.run(Primitive::triangles);
    const Cut first = cut_of(f);
    for (const auto& order :
         {std::array{1u, 2u, 0u}, {2u, 0u, 1u}, {2u, 1u, 0u}, {0u, 2u, 1u}, {1u, 0u, 2u}}) {
      f.indices.assign(order.begin(), order.end());
      f.run(Primitive::triangles);
      ASSERT_EQ(cut_of(f), first) << n;
    }
  }
}

// Points o + a * u + b * v of a plane in clip coordinates, as a grid of 4x4 bent squares, -2 <= a, b <= 2.
struct PlaneGrid {
  static constexpr uint32_t kSquares = 4;
  ClipVertex u, v, o;

  PlaneGrid(std::mt19937& rng, float scale) {
    std::uniform_real_distribution<double> d(-1, 1);
    const double s = double(scale);
    u = {d(rng) * s, d(rng) * s, d(rng), d(rng)};
    v = {d(rng) * s, d(rng) * s, d(rng), d(rng)};
    o = {d(rng) * 0.3, d(rng) * 0.3, d(rng) * 0.3, d(rng)};
  }

  // Both windings and both diagonals, as they come.
  void fill(std::mt19937& rng, Front& f) const {
    std::uniform_real_distribution<double> bend(-0.2, 0.2);
    for (int j = 0; j <= int(kSquares); ++j) {
      for (int i = 0; i <= int(kSquares); ++i) {
        const double a = i - 2 + bend(rng), b = j - 2 + bend(rng);
        f.add(float(o.x + a * u.x + b * v.x), float(o.y + a * u.y + b * v.y), float(o.z + a * u.z + b * v.z),
              float(o.w + a * u.w + b * v.w));
      }
    }
    for (uint32_t j = 0; j < kSquares; ++j) {
      for (uint32_t i = 0; i < kSquares; ++i) {
        const uint32_t p = j * (kSquares + 1) + i, q = p + kSquares + 1;
        const uint32_t ways[2][6] = {{p, p + 1, q + 1, q, p, q + 1}, {p, q, p + 1, q, p + 1, q + 1}};
        const auto& way = ways[rng() % 2];
        f.indices.insert(f.indices.end(), way, way + 6);
      }
    }
  }

  // Is the plane seen at this place of the window, well inside the grid and between near and far?
  bool surely_seen(Real nx, Real ny) const {
    Real b[3];
    if (!weights({u, v, o}, nx, ny, b) || b[2] <= 0) return false;
    const Real z = b[0] * Real(u.z) + b[1] * Real(v.z) + b[2] * Real(o.z);
    return std::fabs(b[0]) < b[2] * Real(1.7) && std::fabs(b[1]) < b[2] * Real(1.7) &&
           std::fabs(z) < Real(0.99);
  }
};

TEST(Clip, SharedEdgesThroughNearAndGuardBandAreCoveredOnce) {
  std::mt19937 rng(4);
  int seen = 0, cut = 0;
  for (int n = 0; n < 200; ++n) {
    Front f(64, 64);
    const PlaneGrid grid(rng, n % 2 ? 1.0f : 3000.0f);
    grid.fill(rng, f);
    f.run(Primitive::triangles);
    for (int i = 0; i < 64 * 64; ++i) {
      const int px = i % 64, py = i / 64, times = times_covered(f, px, py);
      ASSERT_LE(times, 1) << n << ": " << px << "," << py;
      if (!grid.surely_seen((px + Real(0.5)) / 32 - 1, (py + Real(0.5)) / 32 - 1)) continue;
      ASSERT_EQ(times, 1) << n << ": " << px << "," << py;
      ++seen;
      cut += f.segment.clipped > 0;
    }
  }
  EXPECT_GT(seen, 10000);
  EXPECT_GT(cut, 5000);
}

TEST(Clip, LinesEndAtThePlanes) {
  Front f(256, 256);
  f.add(-0.5f, 0, 0, 1), f.add(0.5f, 0, 4, 1);             // leaves by far at a quarter
  f.add(0, -0.5f, 0.5f, 1), f.add(0, 0.5f, -1.5f, 1);      // leaves by near at three quarters
  f.add(0.5f, 0.5f, -2, -1), f.add(0.5f, 0.5f, 0.25f, 1);  // starts behind the eye
  f.add(0, 0, -2, 1), f.add(0.5f, 0.5f, -3, 1);            // not in the volume at all
  f.run(Primitive::lines);
  ASSERT_EQ(f.segment.primitives.size(), 3u);
  const CutTriangle* cut = f.segment.cut_triangles.data();
  EXPECT_EQ(cut[0].x[0], 64 * 256);
  EXPECT_EQ(cut[0].x[1], 96 * 256);
  EXPECT_EQ(cut[0].y[1], 128 * 256);
  EXPECT_EQ(cut[1].y[0], 64 * 256);
  EXPECT_EQ(cut[1].y[1], 160 * 256);
  const PlaneSource& far_cut = f.segment.plane_sources[cut[0].source];
  EXPECT_EQ(far_cut.provoking, 1u);
  EXPECT_NEAR(depth_of(far_cut.planes[0].f0), 0.5, 1e-12);
  EXPECT_NEAR(far_cut.planes[0].dfdx / kSteps * 32, 0.5, 1e-12);
  EXPECT_EQ(far_cut.planes[0].dfdy, 0);
}

// Numbers no program means: whatever they are, corners stay in the guard band and planes are finite.
TEST(Clip, GarbageStaysInBounds) {
  std::mt19937 rng(6);
  for (int n = 0; n < 20000; ++n) {
    Front f(64, 64);
    for (int i = 0; i < 12; ++i) {
      uint32_t bits = uint32_t(rng());
      float v;
      if (n % 2) bits = (bits & 0x80ffffffu) | (rng() % 4 ? 0x3f000000u : 0x7e000000u);
      std::memcpy(&v, &bits, 4);
      f.positions.push_back(rng() % 8 ? v : 0.0f);
    }
    for (int i = 0; i < 6; ++i) f.tex_coords.push_back(float(int(rng())));
    f.sampler.wrap_s = Wrap::repeat;
    for (double& m : f.state->clip_from_object) m = n % 3 ? m : double(int(rng() % 5) - 2);
    for (Primitive mode : {Primitive::triangles, Primitive::line_loop, Primitive::points}) {
      f.run(mode);
      for (const CutTriangle& t : f.segment.cut_triangles) {
        const int corners = mode == Primitive::triangles ? 3 : 2;
        for (int i = 0; i < corners; ++i) {
          ASSERT_GE(std::min(t.x[i], t.y[i]), kGuardBandMin * 256);
          ASSERT_LT(std::max(t.x[i], t.y[i]), kGuardBandMax * 256);
        }
        const PlaneSource& s = f.segment.plane_sources.at(t.source);
        for (int k = 0; k < 4; ++k) {
          ASSERT_TRUE(std::isfinite(s.planes[k].f0) && std::isfinite(s.planes[k].dfdx) &&
                      std::isfinite(s.planes[k].dfdy));
        }
      }
    }
  }
}

}  // namespace
}  // namespace halfspace::raster
