// Small and middling triangles are listed and drawn together: pixels of several, or groups of lanes of one.
// What they leave is what every stage alone leaves where each is drawn by itself, on random heaps of
// triangles that lie over and under each other within a few pixels.
#include <gtest/gtest.h>

#include <array>

#include "tests/support/canvas.h"
#include "tests/support/random.h"
#include "tests/support/textures.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kViewport = 128, kWidth = 100, kHeight = 75;  // tiles of which some are cut

// `view`: a texture, which every third state has.
DrawState any_state(Random& random, const std::shared_ptr<const TextureView>& view) {
  DrawState state = plain_state(kViewport, kViewport);
  if (random.integer(0, 2) == 0) state.texture.view = view;
  if (random.integer(0, 4) != 0)
    state.depth = {true, random.integer(0, 2) != 0 ? CompareFunc::less : CompareFunc(random.integer(0, 7)),
                   random.integer(0, 4) != 0};
  if (random.integer(0, 3) == 0)
    state.blend = {true, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha};
  state.raster.flat_shading = random.integer(0, 3) == 0;
  if (random.integer(0, 5) == 0) {
    state.raster.scissor_test = true;
    state.raster.scissor = {10, 9, 10 + static_cast<int>(random.integer(1, 80)), 70};
  }
  if (random.integer(0, 7) == 0)
    state.polygon.offset_fill = true, state.polygon.offset_factor = random.real(-2, 2);
  if (random.integer(0, 9) == 0) state.alpha_test = {true, CompareFunc::greater, 0.4f};
  if (random.integer(0, 9) == 0) state.stencil.test = true, state.stencil.func = CompareFunc::always;
  return state;
}

// On every `grid`-th place of 1/256 px.
Vertex any_corner(Random& random, int64_t x, int64_t y, int64_t reach, int64_t grid, float w) {
  std::array<float, 4> c{};
  for (float& channel : c) channel = random.real(0, 1);
  const int64_t at_x = x + random.integer(-reach, reach), at_y = y + random.integer(-reach, reach);
  Vertex v = snapped_vertex(at_x / grid * grid, at_y / grid * grid, kViewport, random.real(-0.9f, 0.9f),
                            {c[0], c[1], c[2], c[3]});
  v.x *= w, v.y *= w, v.z *= w, v.w = w;
  v.s = random.real(-1, 2), v.t = random.real(-1, 2);
  return v;
}

// Up to 40 triangles around a place. Sizes go from some that are listed to some that go by groups of lanes,
// together up to edges of 64 pixels and else alone. On a grid of half pixels most edges pass through centres.
std::vector<Vertex> any_heap(Random& random) {
  const int64_t x = random.integer(-5 * 256, (kWidth + 5) * 256),
                y = random.integer(-5 * 256, (kHeight + 5) * 256);
  const int64_t spread = random.integer(0, 12 * 256);
  const bool one_size = random.integer(0, 1) != 0, perspective = random.integer(0, 4) == 0;
  const int64_t grid = random.integer(0, 2) == 0 ? 128 : 1;
  int64_t reach = random.integer(100, 4 * 256);
  std::vector<Vertex> list;
  for (auto n = random.integer(1, 40); n > 0; --n) {
    if (!one_size)
      reach = random.integer(1, 4) == 1 ? random.integer(0, 36 * 256) : random.integer(0, 3 * 256);
    const int64_t dx = random.integer(-spread, spread), dy = random.integer(-spread, spread);
    for (int i = 0; i < 3; ++i) {
      const float w = perspective ? static_cast<float>(1 << random.integer(0, 2)) : 1;
      list.push_back(any_corner(random, x + dx, y + dy, reach, grid, w));
    }
  }
  return list;
}

// `together`: a draw each heap, else each triangle.
Picture draw_stream(uint64_t seed, bool fuse, bool together) {
  Random random(seed);
  Canvas canvas(kWidth, kHeight, 1, ColorFormat::rgba8, fuse);
  canvas.clear({0.1f, 0.2f, 0.3f, 0.4f}, 1);
  TestTexture texture;
  texture.add_noise(random, 16, 8);
  const auto view =
      texture.view(sampler_of(random.integer(0, 1) != 0 ? Filter::linear : Filter::nearest, Wrap::repeat));
  for (int i = 0; i < 25; ++i) {
    const DrawState state = any_state(random, view);
    const std::vector<Vertex> heap = any_heap(random);
    const std::span<const Vertex> all(heap);
    if (together) {
      canvas.draw(state, Primitive::triangles, all);
    } else {
      for (size_t first = 0; first < all.size(); first += 3) {
        canvas.draw(state, Primitive::triangles, all.subspan(first, 3));
        canvas.read({0, 0, 1, 1});  // so that nothing waits for the next one
      }
    }
  }
  return canvas.read();
}

TEST(SmallTriangles, TogetherAsEachAlone) {
  const uint64_t seeds = long_tests() ? 600 : 60;
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    const Picture reference = [&] {
      const IsaScope scope("scalar");
      return draw_stream(seed, false, false);
    }();
    for (const std::string& isa : isa_levels()) {
      const IsaScope scope(isa);
      ASSERT_EQ(first_difference(reference, draw_stream(seed, true, true)), "")
          << "seed " << seed << " on " << isa;
    }
  }
}

}  // namespace
}  // namespace halfspace::test
