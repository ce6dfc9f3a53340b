// Clipping: a floor that runs through the eye against a ray cast, meshes through the near plane, far corners.
#include <gtest/gtest.h>

#include <optional>

#include "tests/oracle/fragment.h"
#include "tests/oracle/triangle.h"
#include "tests/support/canvas.h"
#include "tests/support/random.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 128;
constexpr double kFar = 60, kFloorX = 50, kFloorBack = 20, kFloorFront = -100;

// A view of 90 degrees from the origin along -z (spec 2.11.2, the matrix of glFrustum).
DrawState view(double near) {
  DrawState state = plain_state(kSize, kSize);
  const double a = -(kFar + near) / (kFar - near), b = -2 * kFar * near / (kFar - near);
  state.clip_from_object = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, a, -1, 0, 0, b, 0};
  return state;
}

struct Hit {
  double x, z;
};

// What a ray through window position (wx, wy) meets of the floor y = -1.
std::optional<Hit> cast(double wx, double wy, double near) {
  const double dx = wx / (kSize / 2.0) - 1, dy = wy / (kSize / 2.0) - 1;
  if (dy >= 0) return {};
  const double distance = -1 / dy;
  if (distance < near || distance > kFar || std::fabs(dx * distance) > kFloorX) return {};
  return Hit{dx * distance, -distance};
}

Color floor_color(double x, double z) {
  return {float((x + kFloorX) / (2 * kFloorX)), float((z - kFloorFront) / (kFloorBack - kFloorFront)), 1, 1};
}

// The floor as cells x cells quads. 50 / 8 and 120 / 8 are short binary fractions: no corner is rounded.
std::vector<Vertex> floor_mesh(int cells) {
  std::vector<Vertex> vertices;
  const auto add = [&](int i, int j) {
    const double x = -kFloorX + 2 * kFloorX * i / cells,
                 z = kFloorBack + (kFloorFront - kFloorBack) * j / cells;
    Vertex v;
    v.x = float(x), v.y = -1, v.z = float(z);
    v.color = floor_color(x, z);
    vertices.push_back(v);
  };
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) add(i, j), add(i + 1, j), add(i + 1, j + 1), add(i, j + 1);
  }
  return vertices;
}

// What the pixel may show, given that corners are snapped by up to 1/512 px: the range of the colour over
// rays within `reach` px; empty when these do not agree on whether there is floor at all.
struct Expectation {
  bool decided = true, inside = false;
  double low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9};
};

Expectation expect_at(int x, int y, double near) {
  constexpr double kReach = 1.0 / 200;
  Expectation e;
  int hits = 0;
  for (int k = 0; k < 9; ++k) {
    const auto hit = cast(x + 0.5 + kReach * (k % 3 - 1), y + 0.5 + kReach * (k / 3 - 1), near);
    if (!hit) continue;
    ++hits;
    const Color color = floor_color(hit->x, hit->z);
    const double levels[2] = {255 * double(color.r), 255 * double(color.g)};
    for (int c = 0; c < 2; ++c) {
      e.low[c] = std::min(e.low[c], levels[c]);
      e.high[c] = std::max(e.high[c], levels[c]);
    }
  }
  e.decided = hits == 0 || hits == 9;
  e.inside = hits == 9;
  return e;
}

TEST(Clip, FloorThroughTheEye) {
  for (int cells : {1, 8}) {
    const std::vector<Vertex> mesh = floor_mesh(cells);
    for (int n = 0; n < 100; n += long_tests() ? 1 : 4) {
      // 0.001 .. 30.
      const double near = 0.001 * std::pow(30000.0, n / 99.0);
      Canvas canvas(kSize, kSize);
      DrawState state = view(near);
      state.depth.test = true;
      canvas.draw(state, Primitive::quads, mesh);
      const Picture picture = canvas.read();
      int decided = 0;
      for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
          const Expectation e = expect_at(x, y, near);
          if (!e.decided) continue;
          ++decided;
          const uint8_t* p = picture.pixel(x, y);
          ASSERT_EQ(int(p[2]), e.inside ? 255 : 0)
              << "near " << near << ", cells " << cells << ", pixel " << x << ", " << y;
          if (!e.inside) continue;
          for (int c = 0; c < 2; ++c) {
            ASSERT_GE(p[c], e.low[c] - 0.55)
                << "near " << near << ", cells " << cells << ", pixel " << x << ", " << y;
            ASSERT_LE(p[c], e.high[c] + 0.55)
                << "near " << near << ", cells " << cells << ", pixel " << x << ", " << y;
          }
          // Depth from the ray, by the matrix; a pixel's own slope bounds what snapping can do.
          const auto depth_of = [&](double wy) {
            const double z = cast(x + 0.5, wy, near) ? -1 / (1 - wy / (kSize / 2.0)) : 0;
            const double a = -(kFar + near) / (kFar - near), b = -2 * kFar * near / (kFar - near);
            return (0.5 * (a * z + b) / -z + 0.5) * 16777215;
          };
          const double here = depth_of(y + 0.5), slope = std::fabs(depth_of(y + 0.505) - depth_of(y + 0.495));
          ASSERT_NEAR(here, double(picture.depth_at(x, y)), slope + 1)
              << "near " << near << ", pixel " << x << ", " << y;
        }
      }
      EXPECT_GT(decided, kSize * kSize * 9 / 10);
    }
  }
}

// The floor as a mesh of triangles with corners at random, many of them behind the eye: no pixel twice, and
// none inside the floor left out.
TEST(Clip, SharedEdgesThroughTheNearPlane) {
  Random random(1);
  for (int round = 0; round < (long_tests() ? 300 : 20); ++round) {
    const double near = double(random.real(0.01f, 2));
    constexpr int kCells = 10;
    std::vector<Vertex> corners;
    for (int j = 0; j <= kCells; ++j) {
      for (int i = 0; i <= kCells; ++i) {
        const bool inner = i > 0 && i < kCells && j > 0 && j < kCells;
        Vertex v;
        v.x = float(-kFloorX + 10 * i) + (inner ? random.real(-2.4f, 2.4f) : 0);
        v.y = -1;
        v.z = float(kFloorBack - 12 * j) + (inner ? random.real(-2.9f, 2.9f) : 0);
        v.color = {1.0f / 255, 1.0f / 255, 1.0f / 255, 1};
        corners.push_back(v);
      }
    }
    std::vector<uint32_t> indices;
    for (uint32_t j = 0; j < kCells; ++j) {
      for (uint32_t i = 0; i < kCells; ++i) {
        const uint32_t a = j * (kCells + 1) + i, b = a + 1, d = a + kCells + 1, c = d + 1;
        if (random.integer(0, 1)) {
          indices.insert(indices.end(), {a, b, c, a, c, d});
        } else {
          indices.insert(indices.end(), {d, c, b, d, b, a});
        }
      }
    }
    DrawState state = view(near);
    state.blend = {true, BlendFactor::one, BlendFactor::one};
    Canvas canvas(kSize, kSize);
    canvas.draw(state, Primitive::triangles, corners, indices);
    const Picture picture = canvas.read();
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const int count = picture.pixel(x, y)[0];
        const Expectation e = expect_at(x, y, near);
        ASSERT_LE(count, 1) << "round " << round << ", near " << near << ", pixel " << x << ", " << y;
        if (e.decided) {
          ASSERT_EQ(count, int(e.inside))
              << "round " << round << ", near " << near << ", pixel " << x << ", " << y;
        }
      }
    }
  }
}

// A mesh whose outer corners are 10^4 .. 10^6 px away: the guard band cuts its triangles, and still every
// pixel of the picture is covered exactly once.
TEST(Clip, SharedEdgesThroughTheGuardBand) {
  Random random(2);
  for (int round = 0; round < (long_tests() ? 500 : 40); ++round) {
    const float reach = std::exp2(float(random.integer(8, 14)));  // of 64 px
    constexpr uint32_t kSpokes = 7;
    std::vector<Vertex> v(kSpokes + 1);
    for (uint32_t i = 0; i <= kSpokes; ++i) {
      const double angle = 6.283185307179586 * (i + 0.3 * double(random.real(0, 1))) / kSpokes;
      const float radius = i == kSpokes ? 0.5f : reach * random.real(1, 3);
      v[i].x = radius * float(std::cos(angle));
      v[i].y = radius * float(std::sin(angle));
      v[i].w = random.real(0.5f, 2);
      v[i].x *= v[i].w, v[i].y *= v[i].w;
      v[i].color = {1.0f / 255, 1.0f / 255, 1.0f / 255, 1};
    }
    std::vector<uint32_t> indices;
    for (uint32_t i = 0; i < kSpokes; ++i) {
      const uint32_t next = (i + 1) % kSpokes;
      // Any order of the corners.
      const uint32_t t[3] = {kSpokes, i, next};
      const int64_t turn = random.integer(0, 2);
      for (int64_t k = 0; k < 3; ++k) indices.push_back(t[(turn + (round % 2 ? k : 2 * k)) % 3]);
    }
    DrawState state = plain_state(kSize, kSize);
    state.blend = {true, BlendFactor::one, BlendFactor::one};
    Canvas canvas(kSize, kSize);
    canvas.draw(state, Primitive::triangles, v, indices);
    const Picture picture = canvas.read();
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        ASSERT_EQ(int(picture.pixel(x, y)[0]), 1)
            << "round " << round << ", reach " << reach << ", pixel " << x << ", " << y;
      }
    }
  }
}

// Needles a few sub-pixels wide, cut by the near and the far plane: snapping bends what is left, and still no pixel is
// drawn twice.
TEST(Clip, ABentRemainderIsDrawnOnce) {
  Random random(3);
  for (int round = 0; round < (long_tests() ? 100000 : 3000); ++round) {
    const int64_t x = random.integer(0, 64 * 256), y = random.integer(0, 64 * 256);
    const int64_t dx = random.integer(-40 * 256, 40 * 256), dy = random.integer(-40 * 256, 40 * 256);
    const Color one{1.0f / 255, 1.0f / 255, 1.0f / 255, 1};
    const auto corner = [&](int64_t part, float z) {
      const int64_t aside = random.integer(-3, 3), up = random.integer(-3, 3);
      return snapped_vertex(x + dx * part / 16 + aside, y + dy * part / 16 + up, 64, z, one);
    };
    const int64_t middle = random.integer(1, 15);
    const float z[3] = {random.real(-4, 0), random.real(-2, 2), random.real(0, 4)};
    Vertex v[3] = {corner(0, z[0]), corner(middle, z[1]), corner(16, z[2])};
    DrawState state = plain_state(64, 64);
    state.blend = {true, BlendFactor::one, BlendFactor::one};
    Canvas canvas(64, 64);
    canvas.draw(state, Primitive::triangles, v);
    const Picture picture = canvas.read();
    for (size_t i = 0; i < picture.rgba.size(); i += 4)
      ASSERT_LE(int(picture.rgba[i]), 1) << "round " << round << ", pixel " << i / 4 % 64 << ", " << i / 256;
  }
}

// Attributes of a triangle cut by the guard band come from the whole triangle.
TEST(Clip, FarCornersKeepTheirColours) {
  Random random(3);
  for (int round = 0; round < (long_tests() ? 500 : 40); ++round) {
    std::vector<Vertex> v(3);
    std::array<oracle::ClipPoint, 3> clip;
    for (size_t i = 0; i < 3; ++i) {
      const float reach = i == size_t(round) % 3 ? 2000 : 1.5f;
      v[i].w = random.real(0.5f, 4);
      v[i].x = v[i].w * random.real(-reach, reach);
      v[i].y = v[i].w * random.real(-reach, reach);
      v[i].color.r = random.real(0, 1);
      clip[i] = {double(v[i].x), double(v[i].y), 0, double(v[i].w)};
    }
    const DrawState state = plain_state(kSize, kSize);
    const oracle::Triangle triangle(state.viewport, clip);
    Canvas canvas(kSize, kSize);
    canvas.draw(state, Primitive::triangles, v);
    const Picture picture = canvas.read();
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        // Near an edge snapping decides; elsewhere nothing is left open.
        if (oracle::distance_to_edge(triangle.corners(), x, y) < 0.02) continue;
        const bool covered = triangle.covers(x, y);
        ASSERT_EQ(picture.pixel(x, y)[2], covered ? 255 : 0)
            << "round " << round << ", pixel " << x << ", " << y;
        if (!covered) continue;
        const auto r = triangle.attribute(
            {static_cast<long double>(v[0].color.r), static_cast<long double>(v[1].color.r),
             static_cast<long double>(v[2].color.r)},
            x, y);
        // A corner's snapping moves the plane by 1/512 px of its slope.
        const double slack = 0.51 + 255 * double(std::fabs(r.dx) + std::fabs(r.dy)) / 256;
        ASSERT_LE(std::fabs(double(oracle::level_of(r.value)) - picture.pixel(x, y)[0]), slack)
            << "round " << round << ", pixel " << x << ", " << y;
      }
    }
  }
}

// A vertex exactly on the near and the far plane is inside (spec 2.11: -w <= z <= w).
TEST(Clip, PlanesThemselvesAreInside) {
  for (float z : {-1.0f, 1.0f}) {
    Canvas canvas(16, 16);
    canvas.draw_plain(plain_state(16, 16), Primitive::quads, snapped_quad(0, 0, 4096, 4096, 16, z),
                      {1, 1, 1, 1});
    const Picture picture = canvas.read();
    for (size_t i = 0; i < picture.rgba.size(); ++i) ASSERT_EQ(int(picture.rgba[i]), 255) << "z " << z;
    canvas.clear();
    canvas.draw_plain(plain_state(16, 16), Primitive::quads, snapped_quad(0, 0, 4096, 4096, 16, z * 1.001f),
                      {1, 1, 1, 1});
    for (uint8_t byte : canvas.read().rgba) ASSERT_EQ(int(byte), 0) << "beyond z " << z;
  }
}

}  // namespace
}  // namespace halfspace::test
