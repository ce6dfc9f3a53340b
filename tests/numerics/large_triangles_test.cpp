// Large triangles take shortcuts: whole blocks of a tile in one call, alpha without slope, depth that is
// decided for a block at once. What they leave is what every stage alone leaves, on random streams of
// commands that mix shortcuts, the general path, and what looks at or changes their surfaces in between.
#include <gtest/gtest.h>

#include <array>

#include "tests/support/canvas.h"
#include "tests/support/random.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kViewport = 256, kWidth = 200, kHeight = 170;

Color any_color(Random& random) {
  std::array<float, 4> c{};
  for (float& channel : c) channel = random.real(0, 1);
  return {c[0], c[1], c[2], c[3]};
}

DepthState any_depth(Random& random) {
  if (random.integer(0, 4) == 0) return {};
  const bool usual = random.integer(0, 3) != 0;
  const auto func = usual ? (random.integer(0, 1) != 0 ? CompareFunc::less : CompareFunc::less_equal)
                          : CompareFunc(random.integer(0, 7));
  return {true, func, random.integer(0, 4) != 0};
}

DrawState any_state(Random& random) {
  DrawState state = plain_state(kViewport, kViewport);
  state.depth = any_depth(random);
  if (random.integer(0, 2) == 0)
    state.blend = {true, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha};
  if (random.integer(0, 9) == 0)
    state.blend = {true, BlendFactor::dst_color, BlendFactor::one_minus_src_color};
  state.raster.flat_shading = random.integer(0, 3) == 0;
  if (random.integer(0, 5) == 0) {
    const auto x = static_cast<int>(random.integer(0, 100)), y = static_cast<int>(random.integer(0, 100));
    state.raster.scissor_test = true;
    state.raster.scissor = {x, y, x + static_cast<int>(random.integer(20, 120)), y + 90};
  }
  if (random.integer(0, 9) == 0) state.color_mask = {true, false, true, true};
  if (random.integer(0, 9) == 0) state.color_mask = {false, false, false, false};
  if (random.integer(0, 9) == 0) state.alpha_test = {true, CompareFunc::greater, 0.4f};
  if (random.integer(0, 9) == 0) state.stencil.test = true, state.stencil.func = CompareFunc::always;
  if (random.integer(0, 7) == 0)
    state.polygon.offset_fill = true, state.polygon.offset_units = random.real(-900, 900);
  return state;
}

// One triangle, or a quad as two: far larger than a tile, or small. Level in depth, colour or alpha now and
// then.
std::vector<Vertex> any_triangles(Random& random, Primitive& primitive) {
  const int64_t reach = random.integer(0, 4) == 0 ? 12 * 256 : 700 * 256;
  const bool level = random.integer(0, 3) == 0, even = random.integer(0, 4) == 0,
             level_alpha = random.integer(0, 2) != 0;
  const bool perspective = random.integer(0, 5) == 0;
  const float middle = random.real(-0.9f, 0.9f), lean = random.integer(0, 2) == 0 ? 1.2f : 0.004f;
  const auto x = random.integer(0, kWidth * 256), y = random.integer(0, kHeight * 256);
  const Color one = any_color(random);
  primitive = random.integer(0, 1) != 0 ? Primitive::quads : Primitive::triangles;
  const int corners = primitive == Primitive::quads ? 4 : 3;
  constexpr std::array<std::array<int64_t, 2>, 4> kWays{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  std::vector<Vertex> list;
  for (int i = 0; i < corners; ++i) {
    const auto& way = kWays[static_cast<size_t>(i)];
    const float z = level ? middle : middle + random.real(-lean, lean);
    Vertex v = snapped_vertex(x + way[0] * random.integer(reach / 2, reach),
                              y + way[1] * random.integer(reach / 2, reach), kViewport, z,
                              even ? one : any_color(random));
    if (level_alpha) v.color.a = one.a;
    if (perspective) {
      const float w = static_cast<float>(1 << random.integer(0, 3));
      v.x *= w, v.y *= w, v.z *= w, v.w = w;
    }
    list.push_back(v);
  }
  return list;
}

void any_clear(Random& random, Canvas& canvas) {
  ClearCommand clear;
  clear.color = random.integer(0, 1) != 0;
  clear.depth = !clear.color || random.integer(0, 1) != 0;
  clear.color_value = any_color(random);
  clear.depth_value = static_cast<double>(random.real(0, 1));
  clear.scissor_test = random.integer(0, 2) != 0;
  clear.scissor = {static_cast<int>(random.integer(0, 90)), 13, 160,
                   static_cast<int>(random.integer(20, 170))};
  canvas.device().clear(clear);
}

Picture draw_stream(uint64_t seed, int threads, bool fuse) {
  Random random(seed);
  Canvas canvas(kWidth, kHeight, threads, ColorFormat::rgba8, fuse);
  canvas.clear({0.1f, 0.2f, 0.3f, 0.4f}, 1);
  for (int i = 0; i < 60; ++i) {
    const auto what = random.integer(0, 19);
    if (what == 0)
      any_clear(random, canvas);
    else if (what == 1)
      canvas.read({5, 7, 90, 100});
    const DrawState state = any_state(random);
    Primitive primitive{};
    for (auto n = random.integer(1, 4); n > 0; --n) {
      const std::vector<Vertex> vertices = any_triangles(random, primitive);
      canvas.draw(state, primitive, vertices);
    }
  }
  return canvas.read();
}

TEST(LargeTriangles, ShortcutsLeaveWhatStagesAloneDo) {
  const uint64_t seeds = long_tests() ? 400 : 40;
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    const Picture reference = [&] {
      const IsaScope scope("scalar");
      return draw_stream(seed, 1, false);
    }();
    for (const std::string& isa : isa_levels()) {
      const IsaScope scope(isa);
      for (const int threads : {1, 2}) {
        ASSERT_EQ(first_difference(reference, draw_stream(seed, threads, true)), "")
            << "seed " << seed << " on " << isa << " with " << threads << " threads";
      }
    }
  }
}

}  // namespace
}  // namespace halfspace::test
