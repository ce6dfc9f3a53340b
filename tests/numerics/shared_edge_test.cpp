// Spec 3.5.1 and appendix B, corollary 17: a fragment on an edge that two polygons share is produced exactly
// once.
#include <gtest/gtest.h>

#include "tests/oracle/coverage.h"
#include "tests/support/canvas.h"
#include "tests/support/random.h"

namespace halfspace::test {
namespace {

using namespace raster;
using oracle::SnappedPoint;

constexpr int kViewport = 128, kWidth = 100, kHeight = 90;
constexpr Color kOne{1.0f / 255, 1.0f / 255, 1.0f / 255, 1.0f / 255};

struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
};

// Draws the mesh with additive blending and returns how often each pixel was hit.
Picture count_fragments(const Mesh& mesh, Primitive primitive = Primitive::triangles, int threads = 1) {
  DrawState state = plain_state(kViewport, kViewport);
  state.blend = {true, BlendFactor::one, BlendFactor::one};
  Canvas canvas(kWidth, kHeight, threads);
  std::vector<Vertex> vertices = mesh.vertices;
  for (Vertex& v : vertices) v.color = kOne;
  canvas.draw(state, primitive, vertices, mesh.indices);
  return canvas.read();
}

// Pixels whose centre lies in [x0, x1) x [y0, y1], as the top-left rule closes a rectangle (1/256 px).
bool in_rectangle(int x, int y, int64_t x0, int64_t y0, int64_t x1, int64_t y1) {
  const int64_t cx = x * 256 + 128, cy = y * 256 + 128;
  return cx >= x0 && cx < x1 && cy > y0 && cy <= y1;
}

// A grid of cells x cells quads over the rectangle; inner corners are moved about at random by up to `jitter`
// (1/256 px), corners sit on multiples of `step`; each quad is halved along a diagonal chosen at random.
struct GridOptions {
  int64_t x0, y0, x1, y1;
  int cells;
  int64_t jitter, step;
};

Mesh grid(Random& random, const GridOptions& o) {
  Mesh mesh;
  for (int j = 0; j <= o.cells; ++j) {
    for (int i = 0; i <= o.cells; ++i) {
      int64_t x = o.x0 + (o.x1 - o.x0) * i / o.cells, y = o.y0 + (o.y1 - o.y0) * j / o.cells;
      if (i > 0 && i < o.cells && j > 0 && j < o.cells) {
        x += o.step * random.integer(-o.jitter / o.step, o.jitter / o.step);
        y += o.step * random.integer(-o.jitter / o.step, o.jitter / o.step);
      }
      mesh.vertices.push_back(snapped_vertex(x, y, kViewport));
    }
  }
  const auto at = [&o](int i, int j) { return uint32_t(j * (o.cells + 1) + i); };
  for (int j = 0; j < o.cells; ++j) {
    for (int i = 0; i < o.cells; ++i) {
      const uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (random.integer(0, 1)) {
        mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
      } else {
        mesh.indices.insert(mesh.indices.end(), {b, c, d, b, d, a});
      }
    }
  }
  return mesh;
}

void expect_once(const Mesh& mesh, const GridOptions& o, int threads = 1) {
  const Picture picture = count_fragments(mesh, Primitive::triangles, threads);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      ASSERT_EQ(int(picture.pixel(x, y)[0]), int(in_rectangle(x, y, o.x0, o.y0, o.x1, o.y1)))
          << "pixel " << x << ", " << y;
    }
  }
}

void expect_once_for(uint64_t seed, const GridOptions& options) {
  Random random(seed);
  for (int i = 0; i < (long_tests() ? 300 : 12) && !testing::Test::HasFatalFailure(); ++i) {
    expect_once(grid(random, options), options, 1 + i % 3);
  }
}

constexpr int64_t kPx = 256;

// Cells of 8 px with corners moved by less than half of it: the mesh stays without folds.
TEST(SharedEdges, RandomCorners) {
  expect_once_for(1, {3 * kPx + 17, 5 * kPx + 99, 83 * kPx + 1, 85 * kPx + 250, 10, 2 * kPx, 1});
}
TEST(SharedEdges, CornersOnSixteenths) { expect_once_for(2, {0, 0, 80 * kPx, 80 * kPx, 10, 2 * kPx, 16}); }
TEST(SharedEdges, CornersOnPixelCentres) {
  expect_once_for(3, {8 * kPx + 128, 4 * kPx + 128, 72 * kPx + 128, 68 * kPx + 128, 8, 2 * kPx, kPx});
}
TEST(SharedEdges, TrianglesSmallerThanAPixel) {
  expect_once_for(4, {10 * kPx, 10 * kPx, 42 * kPx, 42 * kPx, 96, 20, 1});
}
TEST(SharedEdges, GridBeyondThePicture) {
  expect_once_for(5, {-4000 * kPx, -4000 * kPx, 4000 * kPx, 4000 * kPx, 5, 300 * kPx, 1});
}

// A fan around any point of a rectangle covers the rectangle once: each spoke is shared.
TEST(SharedEdges, FanAroundAPoint) {
  Random random(6);
  const int64_t x0 = 6 * kPx, y0 = 7 * kPx, x1 = 90 * kPx, y1 = 80 * kPx;
  for (int round = 0; round < (long_tests() ? 400 : 25); ++round) {
    Mesh mesh;
    const int64_t step = round % 2 ? 128 : 1;
    mesh.vertices.push_back(snapped_vertex(step * random.integer(x0 / step + 1, x1 / step - 1),
                                           step * random.integer(y0 / step + 1, y1 / step - 1), kViewport));
    // The outline, counter-clockwise, with points along the sides.
    constexpr int kSide = 9;
    for (int side = 0; side < 4; ++side) {
      for (int i = 0; i < kSide; ++i) {
        const int64_t along_x = (x1 - x0) * i / kSide, along_y = (y1 - y0) * i / kSide;
        const SnappedPoint p = side == 0   ? SnappedPoint{x0 + along_x, y0}
                               : side == 1 ? SnappedPoint{x1, y0 + along_y}
                               : side == 2 ? SnappedPoint{x1 - along_x, y1}
                                           : SnappedPoint{x0, y1 - along_y};
        mesh.vertices.push_back(snapped_vertex(p.x, p.y, kViewport));
      }
    }
    mesh.vertices.push_back(mesh.vertices[1]);
    const Picture picture = count_fragments(mesh, Primitive::triangle_fan);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        ASSERT_EQ(int(picture.pixel(x, y)[0]), int(in_rectangle(x, y, x0, y0, x1, y1)))
            << "round " << round << ", pixel " << x << ", " << y;
      }
    }
  }
}

// Triangle strips, quad strips, quads and polygons halve their quads without gaps.
TEST(SharedEdges, StripsQuadsAndPolygons) {
  const int64_t x0 = 128, y0 = 128, x1 = 64 * kPx + 128, y1 = 40 * kPx + 128;
  constexpr int kSteps = 16;
  Mesh strip;
  for (int i = 0; i <= kSteps; ++i) {
    const int64_t x = x0 + (x1 - x0) * i / kSteps;
    strip.vertices.push_back(snapped_vertex(x, y0, kViewport));
    strip.vertices.push_back(snapped_vertex(x, y1, kViewport));
  }
  const Mesh quad{snapped_quad(x0, y0, x1, y1, kViewport), {}};
  const auto check = [&](const Mesh& mesh, Primitive primitive) {
    const Picture picture = count_fragments(mesh, primitive);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        ASSERT_EQ(int(picture.pixel(x, y)[0]), int(in_rectangle(x, y, x0, y0, x1, y1)))
            << "primitive " << int(primitive) << ", pixel " << x << ", " << y;
      }
    }
  };
  check(strip, Primitive::triangle_strip);
  check(strip, Primitive::quad_strip);
  check(quad, Primitive::quads);
  check(quad, Primitive::polygon);
  check(quad, Primitive::triangle_fan);
}

}  // namespace
}  // namespace halfspace::test
