// The law: one image. The same commands give the same bytes on every instruction set and every number of
// threads, and however the commands are cut into batches.
#include <gtest/gtest.h>

#include <array>
#include <iostream>
#include <set>

#include "tests/support/canvas.h"
#include "tests/support/scenes.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 200;  // sixteen tiles, the outer ones cut

std::vector<Scene> all_scenes() {
  std::vector<Scene> all = scenes(kSize);
  for (Scene& scene : far_scenes(kSize)) all.push_back(std::move(scene));
  return all;
}

Picture draw(const Scene& scene, int threads) {
  Canvas canvas(kSize, kSize, threads);
  draw_scene(canvas, scene);
  return canvas.read();
}

TEST(Identity, EveryInstructionSetAndThreadCount) {
  const std::vector<std::string> levels = isa_levels();
  ASSERT_FALSE(levels.empty());
  EXPECT_EQ(levels.front(), "scalar");
  for (const Scene& scene : all_scenes()) {
    const Picture reference = [&] {
      const IsaScope scope("scalar");
      return draw(scene, 1);
    }();
    for (const std::string& isa : levels) {
      const IsaScope scope(isa);
      ASSERT_EQ(isa_name(), isa);
      for (int threads : {1, 2, 3, 8}) {
        EXPECT_EQ(first_difference(reference, draw(scene, threads)), "")
            << scene.name << " on " << isa << " with " << threads << " threads, against scalar with one";
      }
    }
    std::cout << "image " << scene.name << " " << std::hex << hash(reference) << std::dec << "\n";
  }
}

// A fused kernel is made of the stages' own bodies: run one after another, they give the same bytes.
TEST(Identity, StagesAloneAndFused) {
  for (const Scene& scene : all_scenes()) {
    const Picture fused = draw(scene, 1);
    for (const std::string& isa : isa_levels()) {
      const IsaScope scope(isa);
      Canvas canvas(kSize, kSize, 1, ColorFormat::rgba8, false);
      draw_scene(canvas, scene);
      EXPECT_EQ(first_difference(fused, canvas.read()), "")
          << scene.name << " on " << isa << ", every stage alone";
    }
  }
}

// A scene shows something, and not one flat colour: otherwise equal bytes would prove nothing.
TEST(Identity, ScenesAreNotEmpty) {
  for (const Scene& scene : all_scenes()) {
    const Picture picture = draw(scene, 1);
    size_t drawn = 0;
    std::set<std::array<uint8_t, 4>> colors;
    for (size_t i = 0; i < picture.rgba.size(); i += 4) {
      drawn += picture.rgba[i] || picture.rgba[i + 1] || picture.rgba[i + 2];
      colors.insert({picture.rgba[i], picture.rgba[i + 1], picture.rgba[i + 2], picture.rgba[i + 3]});
    }
    EXPECT_GT(drawn, 300u) << scene.name;
    EXPECT_GT(colors.size(), 10u) << scene.name;
  }
}

// Finishing after every draw is the same as finishing once.
TEST(Identity, FinishingEarlyChangesNothing) {
  for (const Scene& scene : all_scenes()) {
    Canvas canvas(kSize, kSize, 2);
    for (const SceneDraw& one : scene.draws) {
      draw_scene(canvas, Scene{scene.name, {one}});
      canvas.device().finish();
    }
    EXPECT_EQ(first_difference(draw(scene, 2), canvas.read()), "") << scene.name;
  }
}

// One draw of many primitives is many draws of one: any cut of a list of triangles gives the same bytes.
TEST(Identity, SplitDrawsChangeNothing) {
  for (const Scene& scene : all_scenes()) {
    Scene split{scene.name, {}};
    for (const SceneDraw& whole : scene.draws) {
      if (whole.primitive != Primitive::triangles || !whole.indices.empty() || whole.vertices.size() > 2100) {
        split.draws.push_back(whole);
        continue;
      }
      for (size_t i = 0; i + 2 < whole.vertices.size(); i += 3) {
        SceneDraw part{whole.state, whole.primitive, {}, {}};
        part.vertices.assign(whole.vertices.begin() + long(i), whole.vertices.begin() + long(i) + 3);
        split.draws.push_back(std::move(part));
      }
    }
    EXPECT_EQ(first_difference(draw(scene, 1), draw(split, 3)), "") << scene.name;
  }
}

// Tiles of one batch are drawn while the next is filled. All scenes over each other, often enough for several
// batches, with depth, stencil and the other colour plane coming to be on the way.
TEST(Identity, BatchesOverlap) {
  const auto draw_often = [](int threads, uint64_t& passes) {
    Canvas canvas(kSize, kSize, threads);
    size_t vertices = 0;
    while (vertices < 400000) {
      for (const Scene& scene : all_scenes()) {
        draw_scene(canvas, scene);
        for (const SceneDraw& one : scene.draws) vertices += one.vertices.size();
      }
    }
    Picture picture = canvas.read();
    passes = canvas.device().statistics().passes;
    return picture;
  };
  uint64_t passes = 0;
  const Picture reference = draw_often(1, passes);
  for (const int threads : {2, 3, 8}) {
    EXPECT_EQ(first_difference(reference, draw_often(threads, passes)), "") << threads << " threads";
    EXPECT_GT(passes, 4u) << threads << " threads: nothing overlapped";
  }
}

// The conversion on finish shows the same picture as read_color.
TEST(Identity, ResolveShowsWhatReadColorReads) {
  for (const std::string& isa : isa_levels()) {
    const IsaScope scope(isa);
    const Scene scene = scenes(kSize)[1];
    const Picture expected = draw(scene, 1);
    for (bool y_up : {true, false}) {
      for (PixelLayout layout : {PixelLayout::rgba, PixelLayout::bgra, PixelLayout::argb, PixelLayout::rgb,
                                 PixelLayout::bgr, PixelLayout::rgb565, PixelLayout::bgrx}) {
        const int bytes = layout == PixelLayout::rgb565                              ? 2
                          : layout == PixelLayout::rgb || layout == PixelLayout::bgr ? 3
                                                                                     : 4;
        Canvas canvas(kSize, kSize, 2);
        draw_scene(canvas, scene);
        const ptrdiff_t row = kSize * bytes + 12;
        std::vector<uint8_t> out(size_t(row * kSize), 99);
        LinearImage image;
        image.data = out.data();
        image.row_bytes = row;
        image.width = image.height = kSize;
        image.layout = layout;
        image.y_up = y_up;
        canvas.device().finish(&image);
        for (int y = 0; y < kSize; ++y) {
          const uint8_t* line = out.data() + row * (y_up ? y : kSize - 1 - y);
          for (int x = 0; x < kSize; ++x) {
            const uint8_t *p = line + x * bytes, *e = expected.pixel(x, y);
            switch (layout) {
              case PixelLayout::rgba:
                ASSERT_TRUE(p[0] == e[0] && p[1] == e[1] && p[2] == e[2] && p[3] == e[3]);
                break;
              case PixelLayout::bgra:
                ASSERT_TRUE(p[2] == e[0] && p[1] == e[1] && p[0] == e[2] && p[3] == e[3]);
                break;
              case PixelLayout::argb:
                ASSERT_TRUE(p[1] == e[0] && p[2] == e[1] && p[3] == e[2] && p[0] == e[3]);
                break;
              case PixelLayout::bgrx:
                ASSERT_TRUE(p[2] == e[0] && p[1] == e[1] && p[0] == e[2]);
                break;
              case PixelLayout::rgb:
                ASSERT_TRUE(p[0] == e[0] && p[1] == e[1] && p[2] == e[2]);
                break;
              case PixelLayout::bgr:
                ASSERT_TRUE(p[2] == e[0] && p[1] == e[1] && p[0] == e[2]);
                break;
              case PixelLayout::rgb565: {
                // Nearest of 32, 64, 32 values.
                const int word = p[0] | p[1] << 8;
                ASSERT_EQ(word >> 11, (e[0] * 31 + 127) / 255);
                ASSERT_EQ(word >> 5 & 63, (e[1] * 63 + 127) / 255);
                ASSERT_EQ(word & 31, (e[2] * 31 + 127) / 255);
                break;
              }
            }
          }
          for (int pad = 0; pad < 12; ++pad) ASSERT_EQ(int(line[kSize * bytes + pad]), 99);
        }
      }
    }
  }
}

}  // namespace
}  // namespace halfspace::test
