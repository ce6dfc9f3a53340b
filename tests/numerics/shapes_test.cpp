// Wide, stippled and smooth points and lines (spec 3.3, 3.4) and smooth polygons, against the specification's
// own constructions.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "raster/tile/cover_smooth.h"
#include "tests/support/canvas.h"
#include "tests/support/random.h"

namespace halfspace::test {
namespace {

using namespace raster;

using Pixels = std::map<std::pair<int, int>, int>;  // how often each was made

constexpr Rect kEverywhere{-1000, -1000, 1000, 1000};

Pixels covered(const LineEnds& ends, int width, const LineStipple& stipple = {}) {
  Pixels pixels;
  for (int tile = 0; tile < 4; ++tile) {
    const int x = tile % 2 * kTileSize, y = tile / 2 * kTileSize;
    TileCoverage coverage;
    cover_line(ends, width, stipple, x, y, kEverywhere, kEverywhere, coverage);
    for (int b = 0; b < 64; ++b) {
      if (!(coverage.touched >> b & 1)) continue;
      for (int i = 0; i < 64; ++i) {
        if (coverage.blocks[b] >> i & 1) ++pixels[{x + b % 8 * 8 + i % 8, y + b / 8 * 8 + i / 8}];
      }
    }
  }
  return pixels;
}

LineEnds random_line(Random& random) {
  const auto place = [&] { return int32_t(random.integer(20 * 256, 108 * 256)); };
  LineEnds ends{place(), place(), place(), place()};
  if (random.integer(0, 3) == 0) ends.y1 = ends.y0;
  if (random.integer(0, 3) == 0) ends.x1 = ends.x0;
  return ends;
}

bool is_steep(const LineEnds& e) { return std::abs(e.y1 - e.y0) > std::abs(e.x1 - e.x0); }

// Spec 3.4.2.1: the segment moved by (w - 1) / 2 along the minor axis, each fragment a column of w.
TEST(WideLines, ReplicateAlongTheMinorAxis) {
  Random random(3);
  for (int round = 0; round < 500; ++round) {
    const LineEnds ends = random_line(random);
    const int width = int(random.integer(1, 9));
    LineEnds moved = ends;
    const bool steep = is_steep(ends);
    (steep ? moved.x0 : moved.y0) -= (width - 1) * 128;
    (steep ? moved.x1 : moved.y1) -= (width - 1) * 128;
    Pixels expected;
    for (const auto& [pixel, count] : covered(moved, 1)) {
      for (int k = 0; k < width; ++k)
        ++expected[{pixel.first + (steep ? k : 0), pixel.second + (steep ? 0 : k)}];
    }
    ASSERT_EQ(covered(ends, width), expected) << "round " << round << ", width " << width;
  }
}

// Spec 3.4.2.2: fragment s of the line, in its own direction, is made if bit floor(s / r) mod 16 of the
// pattern is set; a strip goes on counting.
TEST(StippledLines, CountFragments) {
  Random random(4);
  for (int round = 0; round < 500; ++round) {
    const LineEnds ends = random_line(random);
    LineStipple stipple{true, uint16_t(random.integer(0, 65535)), int(random.integer(1, 5)), 0};
    stipple.start = uint32_t(random.integer(0, 16 * stipple.repeat - 1));
    const bool steep = is_steep(ends), forward = steep ? ends.y1 > ends.y0 : ends.x1 > ends.x0;
    std::map<int, std::pair<int, int>> along;  // by place along the major axis
    for (const auto& [pixel, count] : covered(ends, 1)) {
      const int u = steep ? pixel.second : pixel.first;
      ASSERT_TRUE(along.emplace(forward ? u : -u, pixel).second) << "two fragments in one column";
    }
    Pixels expected;
    uint32_t s = stipple.start;
    for (const auto& [place, pixel] : along) {
      if (stipple.pattern >> (s / uint32_t(stipple.repeat) % 16) & 1) expected[pixel] = 1;
      ++s;
    }
    ASSERT_EQ(covered(ends, 1, stipple), expected) << "round " << round;
    ASSERT_EQ(line_run(ends, 1).count, along.size());
  }
}

DrawState adding_state(int size) {
  DrawState state = plain_state(size, size);
  state.blend = {true, BlendFactor::one, BlendFactor::one};
  return state;
}

constexpr Color kOne{1.0f / 255, 0, 0, 0};

// A strip is one line as far as its stipple goes: whole, in two packets of which the second goes on, and
// closed.
TEST(StippledLines, RunOnAlongStrips) {
  constexpr int kSize = 64;
  DrawState state = adding_state(kSize);
  state.line.stipple = true;
  state.line.pattern = 0x0f35;
  state.line.repeat = 2;
  // Along a row of pixels, so that fragment s is the pixel 2 + s.
  std::vector<Vertex> v;
  for (int x : {2, 9, 10, 33, 60}) v.push_back(snapped_vertex(x * 256 + 128, 20 * 256 + 128, kSize));
  const auto drawn = [&](auto draw) {
    Canvas canvas(kSize, kSize);
    draw(canvas);
    return canvas.read();
  };
  const auto packet = [&](size_t first, size_t count, bool continues) {
    DrawPacket p;
    p.state = std::make_shared<DrawState>(state);
    p.primitive = Primitive::line_strip;
    p.batch.position = {&v[first].x, sizeof(Vertex), 4};
    p.batch.color = {&kOne, 0, 4};
    p.batch.count = p.index_count = uint32_t(count);
    p.continues = continues;
    return p;
  };
  const Picture whole = drawn([&](Canvas& c) { c.device().draw(packet(0, 5, false)); });
  for (int x = 0; x < kSize; ++x) {
    const int s = x - 2;
    const bool on = s >= 0 && s < 58 && (0x0f35 >> (s / 2 % 16) & 1);
    ASSERT_EQ(int(whole.pixel(x, 20)[0]), int(on)) << "pixel " << x;
  }
  const Picture parted = drawn([&](Canvas& c) {
    c.device().draw(packet(0, 3, false));
    c.device().draw(packet(2, 3, true));
  });
  EXPECT_EQ(first_difference(whole, parted), "");
  const Picture anew = drawn([&](Canvas& c) {
    c.device().draw(packet(0, 3, false));
    c.device().draw(packet(2, 3, false));
  });
  EXPECT_NE(first_difference(whole, anew), "");
}

// Spec 3.3: around floor(x) + 1/2 for odd sizes, floor(x + 1/2) for even ones, at 16 x 16 phases; sizes are
// rounded.
TEST(LargePoints, AreSquaresAroundTheNearestCenterOrCorner) {
  constexpr int kSize = 32;
  for (const float size : {1.4f, 2.0f, 2.6f, 4.0f, 5.0f}) {
    const int whole = int(std::lround(size));
    DrawState state = adding_state(kSize);
    state.point.size = size;
    for (int phase = 0; phase < 256; ++phase) {
      const int64_t x = 12 * 256 + phase % 16 * 16, y = 15 * 256 + phase / 16 * 16;
      Canvas canvas(kSize, kSize);
      const std::vector<Vertex> v{snapped_vertex(x, y, kSize)};
      canvas.draw_plain(state, Primitive::points, v, kOne);
      const Picture picture = canvas.read();
      const auto center = [&](int64_t at) {
        const double p = double(at) / 256;
        return whole % 2 != 0 ? std::floor(p) + 0.5 : std::floor(p + 0.5);
      };
      for (int py = 0; py < kSize; ++py) {
        for (int px = 0; px < kSize; ++px) {
          const bool inside =
              std::fabs(px + 0.5 - center(x)) < whole / 2.0 && std::fabs(py + 0.5 - center(y)) < whole / 2.0;
          ASSERT_EQ(int(picture.pixel(px, py)[0]), int(inside))
              << size << ": " << px << ", " << py << ", phase " << phase;
        }
      }
    }
  }
}

// Spec 2.11: clipping is about the point's and the line's own coordinates; what is drawn may reach beyond the
// viewport.
TEST(LargePoints, ReachBeyondTheViewport) {
  constexpr int kSize = 32;
  DrawState state = plain_state(16, 16, 8, 8);
  state.blend = {true, BlendFactor::one, BlendFactor::one};
  state.point.size = 6;
  state.line.width = 6;
  const auto lit = [&](Primitive primitive, const std::vector<Vertex>& v) {
    Canvas canvas(kSize, kSize);
    canvas.draw_plain(state, primitive, v, kOne);
    int count = 0;
    const Picture picture = canvas.read();
    for (size_t i = 0; i < picture.rgba.size(); i += 4) count += picture.rgba[i];
    return count;
  };
  const auto at = [](int64_t x, int64_t y) { return snapped_vertex(x * 256, y * 256, 16); };
  EXPECT_EQ(lit(Primitive::points, {at(0, 8)}), 36);
  std::vector<Vertex> outside{at(0, 8)};
  outside[0].x = -1.001f;
  EXPECT_EQ(lit(Primitive::points, outside), 0);
  EXPECT_EQ(lit(Primitive::lines, {at(2, 16), at(10, 16)}), 48) << "along the upper border, half of it above";
  std::vector<Vertex> above{at(2, 16), at(10, 16)};
  above[0].y = above[1].y = 1.001f;
  EXPECT_EQ(lit(Primitive::lines, above), 0);
}

// --- coverage

double total(const SmoothShape& shape) {
  double sum = 0;
  float coverage[64];
  for (int y = shape.box.y0; y < shape.box.y1; y += 8) {
    for (int x = shape.box.x0; x < shape.box.x1; x += 8) {
      if (cover_block(shape, x, y, coverage) == 0) continue;
      for (float c : coverage) sum += double(c);
    }
  }
  return sum;
}

TEST(SmoothPoints, CoverTheirDisc) {
  for (double size : {1.0, 1.5, 2.0, 3.25, 7.0, 20.0, 64.0}) {
    const double expected = 3.14159265358979 * size * size / 4;
    for (int phase = 0; phase < 256; phase += 5) {
      const SmoothShape shape = smooth_point(100 * 256 + phase % 16 * 16, 90 * 256 + phase / 16 * 16, size);
      ASSERT_NEAR(total(shape), expected, expected * 0.01) << "size " << size << ", phase " << phase;
    }
  }
}

// Each pixel against many chords, in long double; and all of them against the disc.
TEST(SmoothPoints, AreasAtTheExactLevelAreTheIntegrals) {
  Random random(12);
  for (int round = 0; round < (long_tests() ? 300 : 12); ++round) {
    const double size = double(random.integer(8, 200)) / 8;
    const auto x = int32_t(random.integer(0, 255) + 40 * 256), y = int32_t(random.integer(0, 255) + 40 * 256);
    SmoothShape shape = smooth_point(x, y, size);
    shape.level = Level::exact;
    const double expected = 3.14159265358979323846 * size * size / 4;
    ASSERT_NEAR(total(shape), expected, 1e-6 * expected + 1e-5) << size;
    float coverage[64];
    const int left = shape.box.x0, low = shape.box.y0;
    cover_block(shape, left, low, coverage);
    for (int i = 0; i < 64; ++i) {
      constexpr int kRows = 40000;
      long double area = 0;
      for (int row = 0; row < kRows; ++row) {
        const long double v = low + i / 8 + (row + 0.5L) / kRows - y / 256.0L, r = (long double)(size) / 2;
        if (v * v >= r * r) continue;
        const long double half = std::sqrt(r * r - v * v), from = left + i % 8 - x / 256.0L;
        area += std::max(std::min(from + 1, half) - std::max(from, -half), 0.0L) / kRows;
      }
      ASSERT_NEAR(double(coverage[i]), double(area), 3e-6) << size << ", pixel " << i;
    }
  }
}

// Draft counts samples: each pixel within what the edge of a sample's square can hide.
TEST(SmoothPoints, SamplesAtTheDraftLevelAreNear) {
  for (double size : {2.0, 5.5, 20.0}) {
    SmoothShape shape = smooth_point(100 * 256 + 77, 90 * 256 + 130, size);
    const double area = total(shape);
    shape.level = Level::draft;
    EXPECT_NEAR(total(shape), area, 0.06 * area + 0.2) << size;
  }
}

TEST(SmoothLines, CoverTheirRectangle) {
  Random random(8);
  for (int round = 0; round < 300; ++round) {
    const LineEnds ends = random_line(random);
    const double width = double(random.integer(8, 80)) / 8;
    const double dx = (ends.x1 - ends.x0) / 256.0, dy = (ends.y1 - ends.y0) / 256.0;
    const double expected = std::sqrt(dx * dx + dy * dy) * width;
    if (expected == 0) continue;
    ASSERT_NEAR(total(smooth_line(ends, width, {})), expected, expected * 1e-4 + 1e-3) << "round " << round;
    LineStipple every_other{true, 0x5555, 1, 0};
    const SmoothShape dashed = smooth_line(ends, width, every_other);
    double on = 0;  // elements 0, 2, 4 ... of one pixel each, the last one cut at the line's end
    for (double t = 0; t < dashed.length; t += 2) on += std::min(1.0, dashed.length - t);
    ASSERT_NEAR(total(dashed), on * width, expected * 1e-4 + 1e-3) << "round " << round;
  }
}

// Spec 3.5.6, appendix A: triangles that share edges cover every pixel between them wholly.
TEST(SmoothPolygons, NeighboursAddUpToOne) {
  Random random(9);
  for (int round = 0; round < 20; ++round) {
    // A square, and a fan from a point in it to points on its border.
    const int32_t cx = int32_t(random.integer(30 * 256, 60 * 256)),
                  cy = int32_t(random.integer(30 * 256, 60 * 256));
    const int32_t low = 16 * 256 + 77, high = 71 * 256 + 13;
    std::vector<std::pair<int32_t, int32_t>> border;
    for (int side = 0; side < 4; ++side) {
      const int32_t along = int32_t(random.integer(low + 1, high - 1));
      const std::pair<int32_t, int32_t> corner[] = {{low, low}, {high, low}, {high, high}, {low, high}};
      const std::pair<int32_t, int32_t> middle[] = {{along, low}, {high, along}, {along, high}, {low, along}};
      border.push_back(corner[side]);
      border.push_back(middle[side]);
    }
    double sum[88 * 88] = {};
    for (size_t i = 0; i < border.size(); ++i) {
      const auto &a = border[i], &b = border[(i + 1) % border.size()];
      const SmoothShape shape = smooth_triangle({cx, a.first, b.first}, {cy, a.second, b.second});
      for (int y = 0; y < 88; y += 8) {
        for (int x = 0; x < 88; x += 8) {
          float coverage[64];
          if (cover_block(shape, x, y, coverage) == 0) continue;
          for (int k = 0; k < 64; ++k) sum[(y + k / 8) * 88 + x + k % 8] += double(coverage[k]);
        }
      }
    }
    const auto part = [&](int p) {
      return std::clamp(std::min(p + 1.0, high / 256.0) - std::max(double(p), low / 256.0), 0.0, 1.0);
    };
    for (int y = 0; y < 88; ++y) {
      for (int x = 0; x < 88; ++x)
        ASSERT_NEAR(sum[y * 88 + x], part(x) * part(y), 1e-5) << "round " << round << ": " << x << ", " << y;
    }
  }
}

// Spec 3.13: coverage multiplies alpha, and alpha alone. Half a pixel of a triangle with alpha 0.8.
TEST(SmoothPolygons, CoverageMultipliesAlpha) {
  for (const std::string& isa : isa_levels()) {
    IsaScope scope(isa);
    constexpr int kSize = 16;
    Canvas canvas(kSize, kSize);
    DrawState state = plain_state(kSize, kSize);
    state.polygon.smooth = true;
    const auto quad = snapped_quad(4 * 256 + 128, 4 * 256, 8 * 256, 8 * 256, kSize);
    canvas.draw_plain(state, Primitive::quads, quad, {0.4f, 0.6f, 0.2f, 0.8f});
    const Picture picture = canvas.read();
    // The diagonal runs through the square: its pixels are drawn twice, each time in part; look beside it.
    const uint8_t* half = picture.pixel(4, 4);
    EXPECT_EQ(int(half[0]), 102) << isa;
    EXPECT_EQ(int(half[3]), 102) << isa << ": 0.8 * 0.5 * 255";
    EXPECT_EQ(int(picture.pixel(5, 4)[3]), 204) << isa;
    EXPECT_EQ(int(picture.pixel(3, 4)[3]), 0) << isa;
  }
}

// Spec 3.5.2: bit (x mod 32, y mod 32), whatever tile and block the pixel lies in.
TEST(StippledPolygons, TakeTheWindowsPattern) {
  constexpr int kSize = 128;
  Random random(10);
  DrawState state = adding_state(kSize);
  state.polygon.stipple = true;
  for (uint32_t& row : state.polygon.pattern) row = uint32_t(random.bits());
  for (const bool smooth : {false, true}) {
    state.polygon.smooth = smooth;
    Canvas canvas(kSize, kSize);
    // Small triangles and large ones.
    canvas.draw_plain(state, Primitive::quads, snapped_quad(0, 0, 128 * 256, 96 * 256, kSize), kOne);
    for (int x = 0; x < kSize; x += 4)
      canvas.draw_plain(state, Primitive::quads,
                        snapped_quad(x * 256, 96 * 256, (x + 4) * 256, 128 * 256, kSize), kOne);
    const Picture picture = canvas.read();
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const bool on = state.polygon.pattern[size_t(y % 32)] >> (31 - x % 32) & 1;
        ASSERT_EQ(picture.pixel(x, y)[0] != 0, on) << x << ", " << y;
      }
    }
  }
}

// The law: one image, whatever the instruction set and the number of threads; all of the shapes at once.
TEST(Shapes, AreTheSameOnEveryLevelAndThreadCount) {
  constexpr int kSize = 256;
  const auto picture = [&](int threads) {
    Canvas canvas(kSize, kSize, threads);
    Random random(77);
    for (int round = 0; round < 400; ++round) {
      DrawState state = plain_state(200, 200, 20, 30);
      state.depth = {true, CompareFunc::less_equal, true};
      state.blend = {true, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha};
      const auto chance = [&] { return random.integer(0, 2) == 0; };
      state.line = {random.real(0.5f, 9), chance(), chance(), uint16_t(random.integer(0, 65535)),
                    int(random.integer(1, 4))};
      state.point = {random.real(0.5f, 20), chance()};
      state.polygon.front = PolygonMode(random.integer(0, 2));
      state.polygon.back = PolygonMode(random.integer(0, 2));
      state.polygon.smooth = chance();
      state.polygon.stipple = chance();
      for (uint32_t& row : state.polygon.pattern) row = uint32_t(random.bits());
      state.polygon.offset_fill = state.polygon.offset_line = chance();
      state.polygon.offset_factor = random.real(-2, 2);
      state.raster.flat_shading = chance();
      if (chance()) state.clip_planes.enabled = uint8_t(random.integer(0, 63));
      for (auto& plane : state.clip_planes.planes) {
        for (double& p : plane) p = double(random.real(-1, 1));
        plane[3] += 0.5;
      }
      std::vector<Vertex> v(12);
      for (Vertex& vertex : v) {
        vertex.w = random.real(-0.2f, 3);
        vertex.x = random.real(-1.2f, 1.2f) * vertex.w, vertex.y = random.real(-1.2f, 1.2f) * vertex.w;
        vertex.z = random.real(-1.2f, 1.2f) * vertex.w;
        vertex.color = {random.real(0, 1), random.real(0, 1), random.real(0, 1), random.real(0, 1)};
      }
      canvas.draw(state, Primitive(random.integer(0, 9)), v);
    }
    return canvas.read();
  };
  Picture first;
  for (const std::string& isa : isa_levels()) {
    IsaScope scope(isa);
    for (int threads : {1, 4}) {
      const Picture now = picture(threads);
      if (first.rgba.empty()) first = now;
      EXPECT_EQ(first_difference(first, now), "") << isa << ", " << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace halfspace::test
