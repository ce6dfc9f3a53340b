// Set-up takes triangles of several draws at once where it would ask the same of each. What they leave is
// what each draw leaves where nothing follows it, on random streams of small draws of which neighbours differ
// in one thing or another.
#include <gtest/gtest.h>

#include <array>
#include <span>

#include "tests/support/canvas.h"
#include "tests/support/random.h"
#include "tests/support/textures.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kViewport = 128, kWidth = 100, kHeight = 75;

// Of two sizes, with and without mipmaps.
struct Textures {
  std::array<TestTexture, 4> textures;
  Textures() {
    Random random(3);
    for (size_t i = 0; i < textures.size(); ++i) {
      int size = i % 2 ? 16 : 64;
      do {
        textures[i].add_noise(random, size, size);
        size /= 2;
      } while (i >= 2 && size > 0);
    }
  }
};

// What may change from draw to draw; more often than not one thing does.
class Stream {
 public:
  Stream(uint64_t seed, Textures& textures) : random_(seed), textures_(textures) {
    state_ = plain_state(kViewport, kViewport);
    state_.depth = {true, CompareFunc::less, true};
  }

  const DrawState& next_state() {
    for (auto changes = random_.integer(0, 2); changes > 0; --changes) change();
    return state_;
  }

  std::vector<Vertex> next_triangles() {
    std::vector<Vertex> corners;
    x_ = random_.integer(0, 3) == 0 ? random_.integer(0, kWidth * 256) : x_ + random_.integer(0, 5 * 256);
    y_ = random_.integer(0, 3) == 0 ? random_.integer(0, kHeight * 256) : y_;
    const int64_t reach = random_.integer(0, 9) == 0 ? 30 * 256 : random_.integer(100, 5 * 256);
    const bool perspective = random_.integer(0, 4) == 0;
    const float far = random_.integer(0, 15) == 0 ? 5.0f : 0.9f;  // some are cut
    for (auto n = 3 * random_.integer(1, random_.integer(0, 5) == 0 ? 12 : 3); n > 0; --n) {
      Vertex v = snapped_vertex(x_ + random_.integer(-reach, reach), y_ + random_.integer(-reach, reach),
                                kViewport, random_.real(-far, far), some_color());
      const float w = perspective ? static_cast<float>(1 << random_.integer(0, 2)) : 1;
      v.x *= w, v.y *= w, v.z *= w, v.w = w;
      v.s = random_.real(-3, 3), v.t = random_.real(-3, 3);
      if (projective_) v.q = random_.real(0.5f, 2);
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

  void choose_texture() {
    const auto i = size_t(random_.integer(0, 5));
    if (i >= textures_.textures.size()) return state_.texture.view.reset();
    Sampler sampler = sampler_of(random_.integer(0, 1) != 0 ? Filter::linear : Filter::nearest, Wrap::repeat,
                                 i >= 2 ? MipMode::linear : MipMode::none);
    if (random_.integer(0, 1) != 0) sampler.wrap_s = Wrap::clamp;
    if (random_.integer(0, 1) != 0) sampler.wrap_t = Wrap::clamp;
    state_.texture.view = textures_.textures[i].view(sampler);
  }

  void change() {
    switch (random_.integer(0, 11)) {
      case 0:
      case 1:
      case 2:
      case 3:
        return choose_texture();
      case 4:
        state_.fog.enabled = !state_.fog.enabled;
        state_.fog.color = some_color();
        return;
      case 5:
        state_.raster.flat_shading = !state_.raster.flat_shading;
        return;
      case 6:
        state_.raster.scissor_test = !state_.raster.scissor_test;
        state_.raster.scissor = {10, 9, 10 + static_cast<int>(random_.integer(1, 80)), 70};
        return;
      case 7:
        state_.polygon.offset_fill = !state_.polygon.offset_fill;
        state_.polygon.offset_factor = random_.real(-2, 2);
        return;
      case 8:
        state_.blend = {!state_.blend.enabled, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha};
        return;
      case 9:
        state_.accuracy.interpolation = Level(random_.integer(0, 2));
        state_.accuracy.transform = Level(random_.integer(1, 2));
        state_.accuracy.lod = Level(random_.integer(0, 2));
        return;
      case 10:
        projective_ = !projective_;
        return;
      default:
        state_.raster.cull_back = !state_.raster.cull_back;
        return;
    }
  }

  Random random_;
  Textures& textures_;
  DrawState state_;
  bool projective_ = false;
  int64_t x_ = 0, y_ = 0;
};

Picture draw_stream(uint64_t seed, Textures& textures, bool fuse, bool together) {
  Stream stream(seed, textures);
  Canvas canvas(kWidth, kHeight, 1, ColorFormat::rgba8, fuse);
  canvas.clear({0.1f, 0.2f, 0.3f, 0.4f}, 1);
  for (int i = 0; i < 120; ++i) {
    const DrawState state = stream.next_state();
    canvas.draw(state, Primitive::triangles, stream.next_triangles());
    if (!together) canvas.read({0, 0, 1, 1});  // so that nothing waits for the next one
  }
  return canvas.read();
}

TEST(JoinedDraws, TogetherAsEachAlone) {
  Textures textures;
  const uint64_t seeds = long_tests() ? 600 : 60;
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    const Picture reference = [&] {
      const IsaScope scope("scalar");
      return draw_stream(seed, textures, false, false);
    }();
    for (const std::string& isa : isa_levels()) {
      const IsaScope scope(isa);
      ASSERT_EQ(first_difference(reference, draw_stream(seed, textures, true, true)), "")
          << "seed " << seed << " on " << isa;
    }
  }
}

}  // namespace
}  // namespace halfspace::test
