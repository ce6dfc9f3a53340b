// Large triangles take shortcuts: whole blocks of a tile in one call, alpha without slope, depth that is
// decided for a block at once. What they leave is what every stage alone leaves, on random streams of
// commands that mix shortcuts, the general path, and what looks at or changes their surfaces in between.
#include <gtest/gtest.h>

#include <array>

#include "tests/support/canvas.h"
#include "tests/support/random.h"
#include "tests/support/textures.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kViewport = 256, kWidth = 200, kHeight = 170;

// Often the same again, and the near end of the range.
float any_level(Random& random) { return static_cast<float>(random.integer(-2, 1)) / 2; }

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

// What decides most by depth alone.
DrawState simple_state(Random& random) {
  DrawState state = plain_state(kViewport, kViewport);
  state.depth = {true, random.integer(0, 1) != 0 ? CompareFunc::less : CompareFunc::less_equal,
                 random.integer(0, 9) != 0};
  if (random.integer(0, 4) == 0)
    state.blend = {true, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha};
  if (random.integer(0, 4) == 0) state.polygon.offset_fill = true, state.polygon.offset_units = -5;
  return state;
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
    state.polygon.offset_fill = true, state.polygon.offset_units = random.real(-900, 0);
  return state;
}

// Textures and fog in perspective, whose lists of stages go by rows of blocks.
class TexturedStates {
 public:
  explicit TexturedStates(Random& random) {
    for (TestTexture* texture : {&color_, &transparent_})
      for (int size = 32; size > 0; size /= 2) texture->add_noise(random, size, size);
  }
  DrawState any(Random& random) {
    DrawState state = any_state(random);
    Sampler sampler = sampler_of(Filter(random.integer(0, 1)), random.integer(0, 2) != 0 ? Wrap::repeat : Wrap::clamp);
    if (random.integer(0, 2) == 0) sampler.min = Filter::linear, sampler.mip = MipMode::linear;
    state.texture.view = (random.integer(0, 1) != 0 ? color_ : transparent_).view(sampler);
    state.texture.env = EnvMode(random.integer(0, 3));
    if (random.integer(0, 2) == 0) state.fog = {true, FogMode(random.integer(0, 2)), any_color(random), 0.2f, 1, 6};
    if (random.integer(0, 4) == 0) state.alpha_test = {true, CompareFunc::greater, 0.4f};
    if (random.integer(0, 4) == 0) state.accuracy.filter = Level::draft;
    return state;
  }

 private:
  TestTexture color_{BaseFormat::rgb}, transparent_{BaseFormat::rgba};
};

// One triangle, or a quad as two: far larger than a tile, about as large, or small. Level in depth, colour or alpha now and
// then.
std::vector<Vertex> any_triangles(Random& random, Primitive& primitive) {
  constexpr std::array<int64_t, 4> kReaches{12, 30, 700, 700};
  const int64_t reach = kReaches[static_cast<size_t>(random.integer(0, 3))] * 256;
  const bool level = random.integer(0, 1) == 0, even = random.integer(0, 4) == 0,
             level_alpha = random.integer(0, 2) != 0;
  const bool perspective = random.integer(0, 5) == 0;
  const float middle = level ? any_level(random) : random.real(-0.9f, 0.9f),
              lean = random.integer(0, 2) == 0 ? 1.2f : 0.004f;
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
    v.s = static_cast<float>(v.color.r * 9), v.t = static_cast<float>(v.color.g * 5);
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
  clear.color = random.integer(0, 3) == 0;
  clear.depth = !clear.color || random.integer(0, 1) != 0;
  clear.color_value = any_color(random);
  clear.depth_value = random.integer(0, 1) != 0 ? 1 : static_cast<double>(any_level(random)) / 2 + 0.5;
  clear.scissor_test = random.integer(0, 2) != 0;
  clear.scissor = {static_cast<int>(random.integer(0, 90)), 13, 160,
                   static_cast<int>(random.integer(20, 170))};
  canvas.device().clear(clear);
}

// Odd seeds are of simple states, every fourth one's have textures.
Picture draw_stream(uint64_t seed, int threads, bool fuse) {
  Random random(seed);
  Canvas canvas(kWidth, kHeight, threads, ColorFormat::rgba8, fuse);
  canvas.clear({0.1f, 0.2f, 0.3f, 0.4f}, 1);
  TexturedStates textured(random);
  for (int i = 0; i < 60; ++i) {
    const auto what = random.integer(0, 19);
    if (what == 0)
      any_clear(random, canvas);
    else if (what == 1)
      canvas.read({5, 7, 90, 100});
    const DrawState state = seed % 4 == 0 ? textured.any(random) : seed % 2 != 0 ? simple_state(random) : any_state(random);
    Primitive primitive{};
    for (auto n = random.integer(1, 8); n > 0; --n) {
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

// Covers all of the canvas at one depth.
void cover(Canvas& canvas, CompareFunc func, float z, const Color& color) {
  DrawState state = plain_state(kViewport, kViewport);
  state.depth = {true, func, true};
  const auto quad = snapped_quad(-256, -256, 300 * 256, 300 * 256, kViewport, z, color);
  canvas.draw_plain(state, Primitive::quads, quad, color);
}

TEST(LargeTriangles, EqualDepthIsNotLess) {
  Canvas canvas(kWidth, kHeight);
  canvas.clear();
  cover(canvas, CompareFunc::less, -0.5f, {1, 0, 0, 1});
  cover(canvas, CompareFunc::less, -0.5f, {0, 1, 0, 1});
  EXPECT_EQ(canvas.read().pixel(70, 80)[0], 255);
  cover(canvas, CompareFunc::less_equal, -0.5f, {0, 0, 1, 1});
  EXPECT_EQ(canvas.read().pixel(70, 80)[2], 255);
}

TEST(LargeTriangles, PartOfABlockIsClearedNearer) {
  Canvas canvas(kWidth, kHeight);
  canvas.clear();
  cover(canvas, CompareFunc::less, 0.5f, {1, 0, 0, 1});
  ClearCommand clear;
  clear.depth = true;
  clear.depth_value = 0.25;
  clear.scissor_test = true;
  clear.scissor = {3, 3, 61, 61};
  canvas.device().clear(clear);
  cover(canvas, CompareFunc::less, 0, {0, 1, 0, 1});
  const Picture picture = canvas.read();
  EXPECT_EQ(picture.pixel(4, 4)[1], 0);
  EXPECT_EQ(picture.pixel(2, 2)[1], 255);
  EXPECT_EQ(picture.depth_at(4, 4), 4194304u);
  EXPECT_EQ(picture.depth_at(2, 2), 8388608u);
}

// Blocks that a textured triangle covers in part keep, in the rest, what they were cleared to.
TEST(LargeTriangles, PartsOfTexturedBlocksKeepWhatWasCleared) {
  const auto draw = [](bool fuse) {
    Random random(5);
    TestTexture texture{BaseFormat::rgb};
    for (int size = 32; size > 0; size /= 2) texture.add_noise(random, size, size);
    Canvas canvas(kWidth, kHeight, 1, ColorFormat::rgba8, fuse);
    canvas.clear({0.1f, 0.2f, 0.3f, 0.4f}, 1);
    DrawState state = plain_state(kViewport, kViewport);
    state.texture.view = texture.view(sampler_of(Filter::linear, Wrap::repeat));
    std::vector<Vertex> corners;
    constexpr std::array<std::array<int64_t, 2>, 3> kCorners{{{5, 9}, {188, 31}, {70, 160}}};
    for (const auto& at : kCorners) {
      corners.push_back(snapped_vertex(at[0] * 256, at[1] * 256, kViewport, 0, {1, 1, 1, 1}));
      corners.back().s = static_cast<float>(at[0]) / 32, corners.back().t = static_cast<float>(at[1]) / 32;
    }
    canvas.draw(state, Primitive::triangles, corners);
    return canvas.read();
  };
  for (const std::string& isa : isa_levels()) {
    const IsaScope scope(isa);
    const Picture picture = draw(true);
    EXPECT_EQ(first_difference(draw(false), picture), "") << isa;
    EXPECT_EQ(picture.pixel(4, 4)[2], 77) << isa;
    EXPECT_NE(picture.pixel(80, 60)[3], 102) << isa;
  }
}

}  // namespace
}  // namespace halfspace::test
