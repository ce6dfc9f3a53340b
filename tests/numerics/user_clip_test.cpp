// User clip planes (spec 2.11) and polygon modes (spec 3.5.4).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/canvas.h"
#include "tests/support/random.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 128;
constexpr Color kOne{1.0f / 255, 0, 0, 0};

DrawState adding_state() {
  DrawState state = plain_state(kSize, kSize);
  state.blend = {true, BlendFactor::one, BlendFactor::one};
  return state;
}

// A square mesh of (cells x cells) quads whose inner vertices are moved, seen with a w that varies.
std::vector<Vertex> mesh(Random& random, int cells) {
  std::vector<Vertex> grid;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const bool inner = i > 0 && i < cells && j > 0 && j < cells;
      const auto moved = [&](int k) {
        return -0.9f + 1.8f * float(k) / float(cells) + (inner ? random.real(-0.04f, 0.04f) : 0.0f);
      };
      Vertex v;
      v.x = moved(i), v.y = moved(j), v.z = random.real(-0.9f, 0.9f), v.w = random.real(1, 3);
      v.x *= v.w, v.y *= v.w, v.z *= v.w;
      grid.push_back(v);
    }
  }
  std::vector<Vertex> quads;
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const size_t at = size_t(j * (cells + 1) + i), up = size_t(cells + 1);
      for (size_t k : {at, at + 1, at + up + 1, at, at + up + 1, at + up}) quads.push_back(grid[k]);
    }
  }
  return quads;
}

// What a plane and its opposite leave of a mesh is the mesh: every pixel inside exactly once, whichever
// triangle and whichever side of the cut it belongs to.
TEST(UserClip, TwoSidesOfAPlaneMakeTheWholeExactlyOnce) {
  Random random(5);
  for (int round = 0; round < 30; ++round) {
    const std::vector<Vertex> v = mesh(random, 8);
    DrawState state = adding_state();
    const double angle = double(random.real(0, 6.28f));
    const std::array<double, 4> plane{std::cos(angle), std::sin(angle), double(random.real(-1, 1)),
                                      double(random.real(-0.3f, 0.3f))};
    Canvas canvas(kSize, kSize);
    for (const double side : {1.0, -1.0}) {
      state.clip_planes.enabled = 4;
      for (size_t k = 0; k < 4; ++k) state.clip_planes.planes[2][k] = side * plane[k];
      canvas.draw_plain(state, Primitive::triangles, v, kOne);
    }
    const Picture picture = canvas.read();
    // The square reaches from 6.4 to 121.6.
    for (int y = 8; y < 120; ++y) {
      for (int x = 8; x < 120; ++x)
        ASSERT_EQ(int(picture.pixel(x, y)[0]), 1) << "round " << round << ": " << x << ", " << y;
    }
  }
}

// On the plane's side a pixel shows what it shows without the plane, byte for byte; six planes at once.
TEST(UserClip, WhatIsKeptIsAsItWas) {
  DrawState state = plain_state(kSize, kSize);
  state.depth.test = true;
  std::vector<Vertex> v = snapped_quad(0, 0, kSize * 256, kSize * 256, kSize);
  for (size_t i = 0; i < 4; ++i) {
    v[i].z = -0.7f + 0.4f * float(i);
    v[i].color = {float(i) / 3, i == 1 ? 1.0f : 0.0f, i == 2 ? 1.0f : 0.2f, 1};
  }
  Canvas whole(kSize, kSize), cut(kSize, kSize);
  whole.draw(state, Primitive::quads, v);
  state.clip_planes.enabled = 63;
  for (size_t i = 0; i < 6; ++i) {
    const double angle = double(i) * 1.0471975511965976;
    state.clip_planes.planes[i] = {std::cos(angle), std::sin(angle), 0, 0.5};
  }
  cut.draw(state, Primitive::quads, v);
  const Picture a = whole.read(), b = cut.read();
  int kept = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double cx = (x + 0.5) / 64 - 1, cy = (y + 0.5) / 64 - 1;
      double least = 1e9;
      for (const auto& p : state.clip_planes.planes) least = std::min(least, p[0] * cx + p[1] * cy + p[3]);
      if (std::fabs(least) < 0.03) continue;  // within two pixels of a cut
      if (least < 0) {
        ASSERT_EQ(int(b.pixel(x, y)[3]), 0) << x << ", " << y;
        continue;
      }
      for (int k = 0; k < 4; ++k)
        ASSERT_NEAR(int(b.pixel(x, y)[k]), int(a.pixel(x, y)[k]), 1) << x << ", " << y;
      ASSERT_EQ(b.pixel(x, y)[3], a.pixel(x, y)[3]) << x << ", " << y;
      ASSERT_NEAR(double(b.depth_at(x, y)), double(a.depth_at(x, y)), 400) << "half a sub-pixel of slope";
      kept += b.pixel(x, y)[3] != 0;
    }
  }
  EXPECT_GT(kept, 2000);
}

// Planes are about eye coordinates: a projection that loses z altogether does not matter.
TEST(UserClip, WorksWhereTheProjectionIsSingular) {
  DrawState state = adding_state();
  state.clip_from_object = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
  state.clip_planes.enabled = 1;
  state.clip_planes.planes[0] = {0, 0, 1, 0};
  std::vector<Vertex> v = snapped_quad(0, 0, kSize * 256, kSize * 256, kSize);
  v[0].z = v[3].z = -1, v[1].z = v[2].z = 3;  // z = 0 a quarter of the way
  for (const Primitive mode : {Primitive::quads, Primitive::lines}) {
    Canvas canvas(kSize, kSize);
    if (mode == Primitive::lines) {
      v = {snapped_vertex(0, 64 * 256 + 128, kSize, -1),
           snapped_vertex(kSize * 256, 64 * 256 + 128, kSize, 3)};
    }
    canvas.draw_plain(state, mode, v, kOne);
    const Picture picture = canvas.read();
    // The line is half-open: its end lies in the last pixel's diamond.
    for (int x = 0; x < kSize - 1; ++x) {
      if (std::abs(x - 32) <= 1) continue;
      ASSERT_EQ(int(picture.pixel(x, 64)[0]), int(x > 32)) << x;
    }
  }
}

// --- polygon modes

Picture drawn(const DrawState& state, Primitive mode, const std::vector<Vertex>& v,
              const uint8_t* edge_flags = nullptr) {
  Canvas canvas(kSize, kSize);
  DrawPacket packet;
  packet.state = std::make_shared<DrawState>(state);
  packet.primitive = mode;
  packet.batch.position = {&v[0].x, sizeof(Vertex), 4};
  packet.batch.color = {&v[0].color, sizeof(Vertex), 4};
  packet.batch.edge_flag = edge_flags;
  packet.batch.count = packet.index_count = uint32_t(v.size());
  canvas.device().draw(packet);
  return canvas.read();
}

std::vector<Vertex> pentagon() {
  const Color red{0.5f, 0, 0, 0.25f};
  return {snapped_vertex(5000, 4000, kSize, 0, red), snapped_vertex(25000, 6100, kSize, 0, red),
          snapped_vertex(29000, 17000, kSize, 0, red), snapped_vertex(16000, 30000, kSize, 0, red),
          snapped_vertex(3000, 21000, kSize, 0, red)};
}

TEST(PolygonMode, AnOutlineIsALineLoop) {
  DrawState state = adding_state();
  for (const float width : {1.0f, 4.0f}) {
    for (const bool stipple : {false, true}) {
      state.line.width = width;
      state.line.stipple = stipple;
      state.line.pattern = 0x3a5c;
      const std::vector<Vertex> five = pentagon(), four(five.begin(), five.begin() + 4),
                                three(five.begin(), five.begin() + 3);
      state.polygon.front = state.polygon.back = PolygonMode::fill;
      const Picture loops[] = {drawn(state, Primitive::line_loop, three),
                               drawn(state, Primitive::line_loop, four),
                               drawn(state, Primitive::line_loop, five)};
      state.polygon.front = state.polygon.back = PolygonMode::line;
      EXPECT_EQ(first_difference(drawn(state, Primitive::triangles, three), loops[0]), "");
      EXPECT_EQ(first_difference(drawn(state, Primitive::quads, four), loops[1]), "");
      EXPECT_EQ(first_difference(drawn(state, Primitive::polygon, five), loops[2]), "");
      std::vector<Vertex> strip{four[0], four[1], four[3], four[2]};
      EXPECT_EQ(first_difference(drawn(state, Primitive::quad_strip, strip), loops[1]), "");
    }
  }
}

// Spec 3.4.2.2, 3.5.4: each line of GL_LINES and each polygon starts the stipple anew.
TEST(PolygonMode, StippleStartsAnew) {
  DrawState state = adding_state();
  state.line.stipple = true;
  state.line.pattern = 0x3a5c;
  state.line.repeat = 3;
  state.polygon.front = state.polygon.back = PolygonMode::line;
  const auto apart = [&](Primitive mode, const std::vector<Vertex>& v, size_t each) {
    Canvas canvas(kSize, kSize);
    for (size_t i = 0; i < v.size(); i += each) canvas.draw(state, mode, std::span(v).subspan(i, each));
    return canvas.read();
  };
  const std::vector<Vertex> five = pentagon(), lines{five[0], five[1], five[2], five[3], five[4], five[0]};
  const std::vector<Vertex> triangles{five[0], five[1], five[2], five[4], five[2], five[3]};
  EXPECT_EQ(first_difference(drawn(state, Primitive::lines, lines), apart(Primitive::lines, lines, 2)), "");
  EXPECT_EQ(first_difference(drawn(state, Primitive::triangles, triangles),
                             apart(Primitive::triangles, triangles, 3)),
            "");
}

// Spec 2.6.2: the edge that starts at a vertex whose flag is off is not drawn, but flags say nothing in
// strips.
TEST(PolygonMode, EdgeFlags) {
  DrawState state = adding_state();
  const std::vector<Vertex> five = pentagon();
  const uint8_t flags[] = {1, 0, 1, 1, 0};
  const std::vector<Vertex> edges{five[0], five[1], five[2], five[3], five[3], five[4]};
  const Picture lines = drawn(state, Primitive::lines, edges);
  const Picture points = drawn(state, Primitive::points, {five[0], five[2], five[3]});
  state.polygon.front = state.polygon.back = PolygonMode::line;
  EXPECT_EQ(first_difference(drawn(state, Primitive::polygon, five, flags), lines), "");
  EXPECT_EQ(first_difference(drawn(state, Primitive::triangle_strip, five, flags),
                             drawn(state, Primitive::triangle_strip, five)),
            "");
  state.polygon.front = state.polygon.back = PolygonMode::point;
  EXPECT_EQ(first_difference(drawn(state, Primitive::polygon, five, flags), points), "");
}

TEST(PolygonMode, FacesCullingAndTheFlatColor) {
  DrawState state = plain_state(kSize, kSize);
  std::vector<Vertex> five = pentagon();  // counter-clockwise
  state.polygon.back = PolygonMode::line;
  const Picture filled = drawn(plain_state(kSize, kSize), Primitive::polygon, five);
  EXPECT_EQ(first_difference(drawn(state, Primitive::polygon, five), filled), "");
  state.raster.front_is_ccw = false;
  const Picture outline = drawn(plain_state(kSize, kSize), Primitive::line_loop, five);
  EXPECT_EQ(first_difference(drawn(state, Primitive::polygon, five), outline), "");
  state.raster.cull_back = true;
  for (uint8_t byte : drawn(state, Primitive::polygon, five).rgba) ASSERT_EQ(int(byte), 0);
  state.raster.cull_back = false;
  // The whole outline has the first vertex's colour, also where a line of two of the others would have
  // theirs.
  for (size_t i = 1; i < 5; ++i) five[i].color = {0, 1, 0, 1};
  state.raster.flat_shading = true;
  for (const float width : {1.0f, 3.0f}) {
    state.line.width = width;
    const Picture flat = drawn(state, Primitive::polygon, five);
    for (size_t i = 0; i < flat.rgba.size(); i += 4) ASSERT_EQ(int(flat.rgba[i + 1]), 0);
  }
}

// Spec 2.11: an edge a user plane makes is a boundary edge; what is cut off is not drawn.
TEST(PolygonMode, EdgesMadeByUserPlanesAreDrawn) {
  DrawState state = adding_state();
  state.polygon.front = state.polygon.back = PolygonMode::line;
  state.clip_planes.enabled = 1;
  state.clip_planes.planes[0] = {1, 0, 0, 0.00390625};  // x >= 63.75
  const std::vector<Vertex> v =
      snapped_quad(20 * 256 + 128, 30 * 256 + 128, 100 * 256 + 128, 90 * 256 + 128, kSize);
  const Picture picture = drawn(state, Primitive::quads, v);
  for (int y = 32; y < 89; ++y) {
    ASSERT_NE(int(picture.pixel(63, y)[0]), 0) << y;
    ASSERT_EQ(int(picture.pixel(20, y)[0]), 0) << y;
    ASSERT_NE(int(picture.pixel(100, y)[0]), 0) << y;
  }
}

// Spec 2.11, 3.5.4: where the boundary comes back into the view volume a vertex is made, with the flag of the
// edge it lies on; where it leaves starts what is no edge of the polygon. At a user plane that is one.
TEST(PolygonMode, PointsWhereTheBoundaryIsCut) {
  DrawState state = adding_state();
  state.polygon.front = state.polygon.back = PolygonMode::point;
  state.point.size = 9;
  const int low = 30 * 256 + 128, high = 90 * 256 + 128;
  std::vector<Vertex> v = snapped_quad(20 * 256 + 128, low, 180 * 256 + 128, high, kSize);
  const auto marks = [&](const Picture& picture, int x) {
    return std::pair(int(picture.pixel(x, 30)[0]), int(picture.pixel(x, 90)[0]));
  };
  const std::pair neither(0, 0), upper(0, 255), both(255, 255);
  Picture picture = drawn(state, Primitive::quads, v);
  EXPECT_EQ(marks(picture, 20), both);
  EXPECT_EQ(marks(picture, 127), upper);  // the side of the window: counter-clockwise it is left below
  const uint8_t flags[] = {1, 1, 0, 1};
  EXPECT_EQ(marks(drawn(state, Primitive::quads, v, flags), 127), neither);
  // Near: z = -1 half way between 20.5 and 180.5.
  v[0].z = v[3].z = 0, v[1].z = v[2].z = -2;
  picture = drawn(state, Primitive::quads, v);
  EXPECT_EQ(marks(picture, 100), upper);
  EXPECT_EQ(marks(picture, 127), neither);
  state.clip_planes.enabled = 1;
  state.clip_planes.planes[0] = {-1, 0, 0, 0};  // x <= 64
  picture = drawn(state, Primitive::quads, v);
  EXPECT_EQ(marks(picture, 64), both);
  EXPECT_EQ(marks(picture, 100), neither);
}

}  // namespace
}  // namespace halfspace::test
