// Spec 3.1 allows no more than this: a primitive moved by whole pixels gives the same fragments. And the
// order in which a primitive's vertices come decides nothing but the provoking vertex.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/canvas.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 128;  // pixels a side

Picture draw_at(const Scene& scene, int x, int y, int threads) {
  Canvas canvas(x + kSize, y + kSize, threads);
  draw_scene(canvas, scene, x, y);
  return canvas.read({x, y, x + kSize, y + kSize});
}

TEST(Translation, WholePixelsChangeNothing) {
  const int offsets[][2] = {{1, 0}, {0, 1}, {3, 5}, {8, 8}, {61, 67}, {64, 64}, {1021, 257}, {3998, 3998}};
  for (const Scene& scene : scenes(kSize)) {
    const Picture here = draw_at(scene, 0, 0, 1);
    for (const auto& offset : offsets) {
      EXPECT_EQ(first_difference(here, draw_at(scene, offset[0], offset[1], 2)), "")
          << scene.name << " moved by " << offset[0] << ", " << offset[1];
    }
  }
}

TEST(Translation, OrderOfVerticesChangesNothing) {
  for (const Scene& scene : scenes(kSize)) {
    bool turns = true;
    for (const SceneDraw& draw : scene.draws) {
      turns = turns && draw.primitive == Primitive::triangles && draw.indices.empty() &&
              !draw.state.raster.flat_shading;
    }
    if (!turns) continue;
    const Picture before = draw_at(scene, 0, 0, 1);
    for (int turn = 1; turn < 3; ++turn) {
      Scene turned = scene;
      for (SceneDraw& draw : turned.draws) {
        for (size_t i = 0; i + 2 < draw.vertices.size(); i += 3) {
          std::rotate(draw.vertices.begin() + long(i), draw.vertices.begin() + long(i) + turn,
                      draw.vertices.begin() + long(i) + 3);
        }
      }
      EXPECT_EQ(first_difference(before, draw_at(turned, 0, 0, 1)), "")
          << scene.name << " turned by " << turn;
    }
    // The other winding, where nothing is culled.
    Scene mirrored = scene;
    bool culls = false;
    for (SceneDraw& draw : mirrored.draws) {
      culls = culls || draw.state.raster.cull_back || draw.state.raster.cull_front;
      for (size_t i = 0; i + 2 < draw.vertices.size(); i += 3)
        std::swap(draw.vertices[i], draw.vertices[i + 1]);
    }
    if (culls) continue;
    EXPECT_EQ(first_difference(before, draw_at(mirrored, 0, 0, 1)), "") << scene.name << " mirrored";
  }
}

// Cutting the picture elsewhere - by scissor, by a smaller framebuffer, by the guard band of a moved viewport
// - leaves the pixels inside as they were.
TEST(Translation, CuttingLeavesThePixelsInside) {
  for (const Scene& scene : scenes(kSize)) {
    const Picture whole = draw_at(scene, 0, 0, 1);
    Canvas small(77, 91);
    draw_scene(small, scene, 0, 0);
    const Picture corner = small.read();
    const Rect cut{13, 22, 101, 99};
    Canvas scissored(kSize, kSize);
    Scene with_scissor = scene;
    for (SceneDraw& draw : with_scissor.draws) {
      draw.state.raster.scissor =
          draw.state.raster.scissor_test ? intersect(draw.state.raster.scissor, cut) : cut;
      draw.state.raster.scissor_test = true;
    }
    draw_scene(scissored, with_scissor, 0, 0);
    const Picture inside = scissored.read();
    Canvas shifted(kSize, kSize);
    draw_scene(shifted, scene, -40, -30);
    const Picture moved = shifted.read();
    const Picture background = [&] {
      Canvas empty(1, 1);
      return empty.read();
    }();
    const auto same = [](const Picture& a, int ax, int ay, const Picture& b, int bx, int by) {
      return std::equal(a.pixel(ax, ay), a.pixel(ax, ay) + 4, b.pixel(bx, by)) &&
             a.depth_at(ax, ay) == b.depth_at(bx, by);
    };
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        if (x < 77 && y < 91) {
          ASSERT_TRUE(same(whole, x, y, corner, x, y)) << scene.name << ": smaller, " << x << ", " << y;
        }
        const bool is_inside = x >= cut.x0 && x < cut.x1 && y >= cut.y0 && y < cut.y1;
        ASSERT_TRUE(is_inside ? same(whole, x, y, inside, x, y) : same(background, 0, 0, inside, x, y))
            << scene.name << ": scissor, " << x << ", " << y;
        if (x >= 40 && y >= 30) {
          ASSERT_TRUE(same(whole, x, y, moved, x - 40, y - 30))
              << scene.name << ": moved out, " << x << ", " << y;
        }
      }
    }
  }
}

}  // namespace
}  // namespace halfspace::test
