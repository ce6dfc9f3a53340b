// Colours of textured triangles wait until their tile is left, and what is drawn over meanwhile is never
// shaded. What draws leave together is what each leaves where nothing waits for the next one, on random
// streams of draws that cover each other: of all sizes, textured and not, and now and then some that look at
// what is there.
#include <gtest/gtest.h>

#include <array>

#include "tests/support/canvas.h"
#include "tests/support/random.h"
#include "tests/support/textures.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kViewport = 256, kWidth = 200, kHeight = 150;

struct Textures {
  std::array<TestTexture, 2> textures;
  Textures() {
    Random random(5);
    for (int size = 32; size > 0; size /= 2) textures[0].add_noise(random, size, size);
    textures[1].add_noise(random, 16, 8);
  }
};

class Stream {
 public:
  Stream(uint64_t seed, Textures& textures) : random_(seed), textures_(textures) {
    plain_ = plain_state(kViewport, kViewport);
    plain_.depth = {true, CompareFunc::less, true};
  }

  bool one_in(int n) { return random_.integer(1, n) == 1; }

  // Most are textured and opaque; those differ in their texture and its filters.
  DrawState next_state() {
    DrawState state = plain_;
    if (one_in(2)) state.depth.func = CompareFunc::less_equal;
    if (one_in(8)) state.depth.write = false;
    if (!one_in(3)) {
      const bool linear = !one_in(3);
      const bool levels = one_in(3);
      const Wrap wrap = one_in(3) ? Wrap::clamp : Wrap::repeat;
      state.texture.view = textures_.textures[levels ? 0 : 1].view(sampler_of(
          linear ? Filter::linear : Filter::nearest, wrap, levels ? MipMode::linear : MipMode::none));
      if (one_in(4)) state.texture.env = EnvMode::replace;
    }
    state.raster.flat_shading = one_in(6);
    if (one_in(4)) specialize(state);
    return state;
  }

  Primitive next_primitive() {
    if (one_in(12)) return Primitive::points;
    return one_in(12) ? Primitive::lines : Primitive::triangles;
  }

  std::vector<Vertex> next_corners() {
    const bool perspective = one_in(2);
    const int64_t reach = int64_t{256} << random_.integer(1, 8);
    const int64_t x = random_.integer(0, kWidth * 256), y = random_.integer(0, kHeight * 256);
    const float z = random_.real(-0.8f, 0.8f), slope = one_in(3) ? 0.0f : 0.2f;
    std::vector<Vertex> corners;
    for (auto n = 6 * random_.integer(1, one_in(4) ? 6 : 1); n > 0; --n) {
      Vertex v = snapped_vertex(x + random_.integer(-reach, reach), y + random_.integer(-reach, reach),
                                kViewport, z + random_.real(-slope, slope), some_color());
      const float w = perspective ? static_cast<float>(1 << random_.integer(0, 2)) : 1;
      v.x *= w, v.y *= w, v.z *= w, v.w = w;
      v.s = random_.real(-3, 3), v.t = random_.real(-3, 3);
      corners.push_back(v);
    }
    return corners;
  }

 private:
  Color some_color() {
    const auto channel = [&] { return random_.real(0, 1); };
    const float r = channel(), g = channel(), b = channel();
    return {r, g, b, 0.5f};
  }

  void specialize(DrawState& state) {
    switch (random_.integer(0, 12)) {
      case 0:
      case 10:
      case 11:
      case 12:
        state.blend = {true, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha};
        return;
      case 1:
        state.logic_op = {true, LogicOp::xor_};
        return;
      case 2:
        state.color_mask = {true, false, true, false};
        return;
      case 3:
        state.color_mask = {false, false, false, false};
        return;
      case 4:
        state.alpha_test = {true, CompareFunc::greater, 0.25f};
        return;
      case 5:
        state.fog.enabled = true;
        return;
      case 6:
        state.depth.test = false;
        return;
      case 7:
        state.depth.func = CompareFunc::greater;
        return;
      case 8:
        state.polygon.stipple = true, state.polygon.pattern.fill(0x0ff3c5a9u);
        return;
      default:
        state.raster.scissor_test = true;
        state.raster.scissor = {11, 9, 11 + static_cast<int>(random_.integer(1, 180)), 130};
    }
  }

  Random random_;
  Textures& textures_;
  DrawState plain_;
};

// `together`: else each draw is read back, so that nothing of it waits for the next one.
Picture draw_stream(uint64_t seed, Textures& textures, bool fuse, bool together, int threads) {
  Stream stream(seed, textures);
  Canvas canvas(kWidth, kHeight, threads, ColorFormat::rgba8, fuse);
  canvas.clear({0.1f, 0.2f, 0.3f, 0.4f}, 1);
  for (int i = 0; i < 80; ++i) {
    const DrawState state = stream.next_state();
    const Primitive primitive = stream.next_primitive();
    canvas.draw(state, primitive, stream.next_corners());
    if (stream.one_in(20) || !together) canvas.read({0, 0, 1, 1});
  }
  return canvas.read();
}

TEST(DeferredColors, TogetherAsEachAlone) {
  Textures textures;
  const uint64_t seeds = long_tests() ? 400 : 40;
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    const Picture reference = [&] {
      const IsaScope scope("scalar");
      return draw_stream(seed, textures, false, false, 1);
    }();
    for (const std::string& isa : isa_levels()) {
      const IsaScope scope(isa);
      for (int threads : {1, 2})
        ASSERT_EQ(first_difference(reference, draw_stream(seed, textures, true, true, threads)), "")
            << "seed " << seed << " on " << isa << " with " << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace halfspace::test
