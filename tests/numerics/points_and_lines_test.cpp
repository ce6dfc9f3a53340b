// Points and lines through the whole pipeline (the shapes themselves are tested in lines_test.cpp).
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <span>
#include <string>

#include "raster/tile/coverage.h"
#include "tests/support/canvas.h"
#include "tests/support/random.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 32;

DrawState counting_state() {
  DrawState state = plain_state(kSize, kSize);
  state.blend = {true, BlendFactor::one, BlendFactor::one};
  return state;
}

// Spec 3.3: the fragment whose square holds the point; at 16 x 16 sub-pixel phases, edges of pixels included.
TEST(Points, ThePixelThatHoldsIt) {
  for (int64_t phase_x = 0; phase_x < 256; phase_x += 16) {
    for (int64_t phase_y = 0; phase_y < 256; phase_y += 16) {
      Canvas canvas(kSize, kSize);
      const int64_t px = 3 + phase_x / 16, py = 9 + phase_y / 32;
      const std::vector<Vertex> v{
          snapped_vertex(256 * px + phase_x, 256 * py + phase_y, kSize, 0.5f, {0.2f, 0.4f, 0.6f, 0.8f})};
      DrawState state = plain_state(kSize, kSize);
      state.depth.test = true;
      canvas.draw(state, Primitive::points, v);
      const Picture picture = canvas.read();
      for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
          const bool hit = x == px && y == py;
          const uint8_t* p = picture.pixel(x, y);
          ASSERT_EQ(int(p[0]), hit ? 51 : 0) << phase_x << ", " << phase_y << ": pixel " << x << ", " << y;
          if (!hit) continue;
          ASSERT_EQ(int(p[1]), 102);
          ASSERT_EQ(int(p[2]), 153);
          ASSERT_EQ(int(p[3]), 204);
          // 0.75 (2^24 - 1) = 12582911.25
          ASSERT_EQ(picture.depth_at(x, y), 12582911u);
        }
      }
    }
  }
}

// Thousands over each other, over several tiles and more than a batch holds: at each pixel the last one, or
// the nearest.
void expect_many(const DrawState& state, bool constant_color, int threads) {
  constexpr int kSide = 128, kCount = 70000;
  Random random(23);
  std::vector<Vertex> points;
  std::vector<std::array<uint8_t, 4>> expected(kSide * kSide);
  std::vector<uint32_t> depth(kSide * kSide, ~0u);
  for (int i = 0; i < kCount; ++i) {
    const int64_t x = random.integer(0, kSide - 1), y = random.integer(0, kSide - 1),
                  z = random.integer(0, 1000);
    std::array<uint8_t, 4> bytes;
    for (uint8_t& byte : bytes) byte = uint8_t(constant_color ? 77 : random.integer(0, 255));
    const Color color{float(bytes[0]) / 255, float(bytes[1]) / 255, float(bytes[2]) / 255,
                      float(bytes[3]) / 255};
    points.push_back(snapped_vertex(256 * x + random.integer(0, 255), 256 * y + random.integer(0, 255), kSide,
                                    float(z) / 1024, color));
    const size_t at = size_t(y * kSide + x);
    if (state.depth.test && uint32_t(z) >= depth[at]) continue;
    depth[at] = uint32_t(z);
    expected[at] = bytes;
  }
  Canvas canvas(kSide, kSide, threads);
  canvas.clear();
  canvas.draw(state, Primitive::points, points);
  const Picture picture = canvas.read();
  for (size_t i = 0; i < expected.size(); ++i)
    for (size_t k = 0; k < 4; ++k)
      ASSERT_EQ(int(picture.rgba[4 * i + k]), int(expected[i][k])) << "pixel " << i;
}

TEST(Points, ManyComeInTheirOrder) {
  for (const std::string& isa : isa_levels()) {
    const IsaScope scope(isa);
    for (const int threads : {1, 3, 8}) {
      for (const bool constant_color : {false, true}) {
        SCOPED_TRACE(isa + ", " + std::to_string(threads) + " threads");
        DrawState state = plain_state(128, 128);
        expect_many(state, constant_color, threads);
        state.raster.flat_shading = true;
        expect_many(state, constant_color, threads);
        state.depth.test = true;
        expect_many(state, constant_color, threads);
        state.raster.flat_shading = false;
        expect_many(state, constant_color, threads);
      }
    }
  }
}

// Colours of all kinds, some of them none.
std::vector<Vertex> points_of_any_color(size_t count, int side) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN(), kMost = std::numeric_limits<float>::max();
  constexpr std::array<float, 6> kSpecial{kNone, kMost, -kMost, 1e10f, -0.0f, 1};
  Random random(29);
  const auto channel = [&] {
    switch (random.integer(0, 3)) {
      case 0:
        return kSpecial[size_t(random.integer(0, 5))];
      case 1:
        return (float(random.integer(0, 255)) + 0.5f) / 255;
      default:
        return random.real(-0.2f, 1.2f);
    }
  };
  std::vector<Vertex> points;
  for (size_t i = 0; i < count; ++i) {
    const float r = channel(), g = channel(), b = channel(), a = channel();
    points.push_back(snapped_vertex(random.integer(-256, 256 * side), random.integer(-256, 256 * side), side,
                                    float(random.integer(-5, 5)) / 4, {r, g, b, a}));
  }
  return points;
}

// Where a fragment is its point's colour, packets hold pixels. Without fused kernels they do not.
TEST(Points, ColorsAreRoundedAsByTheirStages) {
  constexpr int kSide = 128;
  const std::vector<Vertex> points = points_of_any_color(20000, kSide);
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i < points.size(); ++i) indices.push_back(i * 7 % uint32_t(points.size()));
  constexpr std::array<CompareFunc, 5> kFuncs{CompareFunc::less, CompareFunc::equal,
                                              CompareFunc::greater_equal, CompareFunc::not_equal,
                                              CompareFunc::always};
  for (const std::string& isa : isa_levels()) {
    const IsaScope scope(isa);
    for (int i = 0; i < 4 * int(kFuncs.size()); ++i) {
      DrawState state = plain_state(kSide, kSide);
      state.raster.scissor_test = true;
      state.raster.scissor = {3, 9, 120, 101};
      state.depth.test = i % 4 != 3;
      state.depth.write = i % 2 == 0;
      state.depth.func = kFuncs[size_t(i / 4)];
      Picture pictures[2];
      for (const bool fuse : {false, true}) {
        Canvas canvas(kSide, kSide, 1 + i % 2, ColorFormat::rgba8, fuse);
        canvas.clear({0.3f, 0.2f, 0.1f, 1}, 0.625);
        canvas.draw(state, Primitive::points, points,
                    i % 3 == 0 ? std::span<const uint32_t>(indices) : std::span<const uint32_t>());
        canvas.draw_plain(state, Primitive::points, std::span(points).first(50), {0.7f, 0.3f, 0.5f, 0.1f});
        pictures[fuse ? 1 : 0] = canvas.read();
      }
      ASSERT_EQ(first_difference(pictures[0], pictures[1]), "") << isa << ", " << i;
    }
  }
}

// Spec 2.11: a point outside the view volume is discarded, one on its boundary is not.
TEST(Points, OutsideTheVolumeAreDiscarded) {
  Canvas canvas(kSize, kSize);
  for (float beyond : {-1.01f, 1.01f}) {
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Vertex> v(1);
      (&v[0].x)[axis] = beyond;
      canvas.draw(plain_state(16, 16, 8, 8), Primitive::points, v);
    }
  }
  for (uint8_t byte : canvas.read().rgba) ASSERT_EQ(int(byte), 0);
}

// Lines of every direction and of no length, within a pixel and beyond the framebuffer; some are cut, and of
// some the floats would not do.
std::vector<Vertex> mixed_lines(int count, int side, bool perspective) {
  Random random(31);
  const auto place = [&](int64_t low, int64_t high) {
    const int64_t grid = random.integer(0, 3) == 0 ? 128 : 1;
    return random.integer(low * 256 / grid, high * 256 / grid) * grid;
  };
  std::vector<Vertex> vertices;
  for (int i = 0; i < count; ++i) {
    int64_t x = place(-20, side + 20), y = place(-20, side + 20);
    const int64_t reach = random.integer(0, 9) == 0 ? side : random.integer(1, 20);
    for (int k = 0; k < 2; ++k) {
      const Color color{random.real(0, 1), random.real(0, 1), random.real(0, 1), random.real(0, 1)};
      Vertex v = snapped_vertex(x, y, side, random.real(-1, random.integer(0, 9) == 0 ? 1.5f : 1), color);
      if (perspective) {
        const float w = random.integer(0, 9) == 0 ? 1e6f : random.real(1, 4);
        v.x *= w, v.y *= w, v.z *= w, v.w = w;
      }
      vertices.push_back(v);
      x += place(-reach, reach), y += place(-reach, reach);
    }
  }
  return vertices;
}

// Of many lines packets are made, of one none: whatever is drawn between them, and wherever tiles and bounds
// cut them.
TEST(Lines, ManyAreThoseDrawnOneByOne) {
  constexpr int kSide = 150;
  for (int variant = 0; variant < 16; ++variant) {
    DrawState state = variant & 8 ? plain_state(100, 90, 21, 33) : plain_state(kSide, kSide);
    state.depth.test = variant & 1;
    state.raster.flat_shading = variant & 2;
    const std::vector<Vertex> lines = mixed_lines(600, kSide, variant & 4);
    Canvas apart(kSide, kSide);
    apart.clear();
    for (size_t i = 0; i < lines.size(); i += 2)
      apart.draw(state, Primitive::lines, std::span(lines).subspan(i, 2));
    const Picture expected = apart.read();
    for (const std::string& isa : isa_levels()) {
      const IsaScope scope(isa);
      for (const int threads : {1, 8}) {
        Canvas canvas(kSide, kSide, threads);
        canvas.clear();
        canvas.draw(state, Primitive::lines, lines);
        ASSERT_EQ(first_difference(canvas.read(), expected), "")
            << isa << ", " << threads << " threads, " << variant;
      }
    }
  }
}

// Without indices no records are made of vertices but of lines that are cut or take doubles.
TEST(Lines, AreTheSameWithIndices) {
  constexpr int kSide = 150;
  for (const std::string& isa : isa_levels()) {
    const IsaScope scope(isa);
    for (int variant = 0; variant < 48; ++variant) {
      DrawState state = plain_state(kSide, kSide);
      state.depth.test = variant & 1;
      state.raster.flat_shading = variant & 2;
      std::vector<Vertex> lines = mixed_lines(8 + 5 * variant, kSide, variant & 4);
      const std::vector<Vertex> colors = points_of_any_color(lines.size(), kSide);
      for (size_t i = 0; i < lines.size(); ++i)
        if (variant & 8) lines[i].color = colors[i].color;
      if (variant % 5 == 1) lines[size_t(variant)].x = std::numeric_limits<float>::quiet_NaN();
      std::vector<uint32_t> indices;
      for (uint32_t i = 0; i < lines.size(); ++i) indices.push_back(i);
      Canvas given(kSide, kSide), indexed(kSide, kSide);
      given.clear(), indexed.clear();
      given.draw(state, Primitive::lines, lines);
      indexed.draw(state, Primitive::lines, lines, indices);
      given.draw_plain(state, Primitive::lines, std::span(lines).first(14), {0.7f, 0.3f, 0.5f, 0.1f});
      indexed.draw_plain(state, Primitive::lines, std::span(lines).first(14), {0.7f, 0.3f, 0.5f, 0.1f});
      ASSERT_EQ(first_difference(given.read(), indexed.read()), "") << isa << ", " << variant;
    }
  }
}

// Of whatever length, and wherever tiles and bounds cut them, by cover_line.
std::vector<bool> covered_by(std::span<const LineEnds> lines, const Rect& bounds, int side) {
  std::vector<bool> covered(static_cast<size_t>(side) * static_cast<size_t>(side));
  for (const LineEnds& line : lines) {
    for (int tile = 0; tile < side / kTileSize * (side / kTileSize); ++tile) {
      const int x0 = tile % (side / kTileSize) * kTileSize, y0 = tile / (side / kTileSize) * kTileSize;
      TileCoverage coverage;
      cover_line(line, 1, {}, x0, y0, bounds, bounds, coverage);
      for (int b = 0; b < 64; ++b) {
        for (int i = 0; i < 64; ++i) {
          const int x = x0 + b % 8 * 8 + i % 8, y = y0 + b / 8 * 8 + i / 8;
          if ((coverage.touched >> b & 1) != 0 && (coverage.blocks[b] >> i & 1) != 0)
            covered[static_cast<size_t>(y * side + x)] = true;
        }
      }
    }
  }
  return covered;
}

TEST(Lines, AreCutFromTileToTile) {
  constexpr int kSide = 3 * kTileSize, kAtOnce = 40;
  constexpr Rect kScissor{10, 20, 170, 150};
  Random random(53);
  for (int round = 0; round < 40; ++round) {
    const int reach = round % 4 == 0 ? kSide : round % 4 == 1 ? kTileSize + 1 : 30;
    std::vector<LineEnds> lines;
    std::vector<Vertex> vertices;
    const auto place = [&](int64_t low, int64_t high) {
      const int64_t grid = random.integer(0, 1) == 0 ? 128 : 1;
      return random.integer(low * 256 / grid, high * 256 / grid) * grid;
    };
    for (int i = 0; i < kAtOnce; ++i) {
      const int64_t x0 = place(-10, kSide + 10), y0 = place(-10, kSide + 10);
      const int64_t x1 = x0 + place(-reach, reach), y1 = y0 + place(-reach, reach);
      vertices.push_back(snapped_vertex(x0, y0, kSide));
      vertices.push_back(snapped_vertex(x1, y1, kSide));
      lines.push_back({static_cast<int32_t>(x0), static_cast<int32_t>(y0), static_cast<int32_t>(x1),
                       static_cast<int32_t>(y1)});
    }
    DrawState state = plain_state(kSide, kSide);
    state.raster.scissor_test = round % 2 == 1;
    state.raster.scissor = kScissor;
    const std::vector<bool> expected =
        covered_by(lines, state.raster.scissor_test ? kScissor : Rect{0, 0, kSide, kSide}, kSide);
    for (const std::string& isa : isa_levels()) {
      const IsaScope scope(isa);
      Canvas canvas(kSide, kSide);
      canvas.clear();
      canvas.draw(state, Primitive::lines, vertices);
      const Picture picture = canvas.read();
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
          ASSERT_EQ(picture.pixel(x, y)[0] != 0, expected[static_cast<size_t>(y * kSide + x)])
              << isa << ", round " << round << ": " << x << ", " << y;
    }
  }
}

// One kernel takes lines to memory, or their fragments wait for stages that run alone: the same bytes. Alpha
// changes along all lines of some stretches, along none of others, and along every other one.
TEST(Lines, AreTheSameFusedOrNot) {
  constexpr int kSide = 192, kCount = 600;
  for (const bool perspective : {false, true}) {
    for (const bool flat : {false, true}) {
      std::vector<Vertex> lines = mixed_lines(kCount, kSide, perspective);
      for (size_t i = 0; i < lines.size(); i += 2) {
        const size_t stretch = i / 100 % 3;
        if (stretch == 0 || (stretch == 1 && i % 4 == 0)) lines[i].color.a = lines[i + 1].color.a;
      }
      DrawState state = plain_state(kSide, kSide);
      state.raster.flat_shading = flat;
      std::vector<uint8_t> first;
      for (const std::string& isa : isa_levels()) {
        const IsaScope scope(isa);
        for (const bool fuse : {true, false}) {
          Canvas canvas(kSide, kSide, 1, ColorFormat::rgba8, fuse);
          canvas.clear();
          canvas.draw(state, Primitive::lines, lines);
          const std::vector<uint8_t> rgba = canvas.read().rgba;
          if (first.empty()) first = rgba;
          ASSERT_EQ(rgba, first) << isa << fuse << perspective << flat;
        }
      }
    }
  }
}

// Their packets, which are of different sizes, share a tile's memory.
TEST(Lines, AndPointsByTurns) {
  constexpr int kSide = 128;
  const DrawState state = plain_state(kSide, kSide);
  Canvas together(kSide, kSide), apart(kSide, kSide);
  together.clear(), apart.clear();
  Random random(41);
  for (int turn = 0; turn < 20; ++turn) {
    const std::vector<Vertex> lines = mixed_lines(8 + turn, kSide, false);
    std::vector<Vertex> points;
    for (int i = 0; i < 500; ++i)
      points.push_back(snapped_vertex(random.integer(0, 256 * kSide - 1), random.integer(0, 256 * kSide - 1),
                                      kSide, 0,
                                      {random.real(0, 1), random.real(0, 1), random.real(0, 1), 1}));
    together.draw(state, Primitive::lines, lines);
    together.draw(state, Primitive::points, points);
    apart.draw(state, Primitive::lines, lines);
    apart.read();
    apart.draw(state, Primitive::points, points);
    apart.read();
  }
  EXPECT_EQ(first_difference(together.read(), apart.read()), "");
}

// Spec 3.4.1: segments of a strip or a loop share their joints, and half-open segments draw a joint inside a
// diamond once.
TEST(Lines, LoopsDrawEachJointOnce) {
  Random random(1);
  for (int round = 0; round < 100; ++round) {
    // A triangle with long sides; its corners anywhere inside the diamonds of three pixels.
    constexpr int kJoints[3][2] = {{2, 3}, {28, 6}, {12, 29}};
    std::vector<Vertex> v;
    for (const auto& joint : kJoints) {
      const int64_t dx = random.integer(-127, 127),
                    dy = random.integer(std::abs(dx) - 127, 127 - std::abs(dx));
      v.push_back(snapped_vertex(256 * joint[0] + 128 + dx, 256 * joint[1] + 128 + dy, kSize));
    }
    const auto count = [](Primitive primitive, const std::vector<Vertex>& vertices) {
      Canvas canvas(kSize, kSize);
      canvas.draw_plain(counting_state(), primitive, vertices, {1.0f / 255, 0, 0, 0});
      return canvas.read();
    };
    const Picture loop = count(Primitive::line_loop, v);
    const std::vector<Vertex> closed{v[0], v[1], v[2], v[0]};
    const std::vector<Vertex> pairs{v[0], v[1], v[1], v[2], v[2], v[0]};
    EXPECT_EQ(first_difference(loop, count(Primitive::line_strip, closed)), "");
    EXPECT_EQ(first_difference(loop, count(Primitive::lines, pairs)), "");
    for (const auto& joint : kJoints) {
      ASSERT_EQ(int(loop.pixel(joint[0], joint[1])[0]), 1) << "round " << round << ", joint " << joint[0];
    }
    // Next to a joint both sides may rightly pass through one diamond; elsewhere they are apart.
    int drawn = 0;
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const int hits = loop.pixel(x, y)[0];
        bool near_joint = false;
        for (const auto& joint : kJoints) {
          near_joint = near_joint || (std::abs(x - joint[0]) <= 2 && std::abs(y - joint[1]) <= 2);
        }
        if (!near_joint) {
          ASSERT_LE(hits, 1) << "round " << round << ", pixel " << x << ", " << y;
        }
        drawn += hits > 0;
      }
    }
    EXPECT_GT(drawn, 60);
  }
}

// Spec 3.4.1, equation 3.4: along an x-major line through pixel centres, the value at the centre's share of
// the way.
TEST(Lines, InterpolateAlongTheSegment) {
  for (bool perspective : {false, true}) {
    Canvas canvas(kSize, kSize);
    std::vector<Vertex> v{snapped_vertex(128, 20 * 256 + 128, kSize, -1, {0, 1, 0, 1}),
                          snapped_vertex(30 * 256 + 128, 20 * 256 + 128, kSize, 1, {1, 0, 0, 1})};
    const float w = perspective ? 4 : 1;
    v[1].x *= w, v[1].y *= w, v[1].z *= w, v[1].w = w;
    DrawState state = plain_state(kSize, kSize);
    state.depth.test = true;
    canvas.draw(state, Primitive::lines, v);
    const Picture picture = canvas.read();
    for (int x = 0; x < 30; ++x) {
      const double t = x / 30.0, share = (t / double(w)) / (1 - t + t / double(w));
      ASSERT_NEAR(picture.pixel(x, 20)[0], 255 * share, 0.51) << "pixel " << x << ", w " << w;
      ASSERT_NEAR(picture.pixel(x, 20)[1], 255 * (1 - share), 0.51) << "pixel " << x << ", w " << w;
      ASSERT_NEAR(picture.depth_at(x, 20), 16777215 * t, 0.51) << "pixel " << x << ", w " << w;
    }
    EXPECT_EQ(int(picture.pixel(30, 20)[3]), 0) << "half-open: the last end's pixel is not drawn";
  }
}

}  // namespace
}  // namespace halfspace::test
