// A tile looks up how deep small triangles have drawn, and leaves out what lies behind. That changes nothing:
// what large draws leave is what each few of their triangles leave where nobody has looked yet, on random
// streams that cover the picture several times over, at depths a few steps apart.
#include <gtest/gtest.h>

#include "tests/support/canvas.h"
#include "tests/support/random.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kViewport = 128, kWidth = 100, kHeight = 75;
constexpr size_t kFew = 24;  // triangles: fewer than a tile looks up depths for

class Stream {
 public:
  explicit Stream(uint64_t seed) : random_(seed), plain_(plain_state(kViewport, kViewport)) {
    plain_.depth = {true, CompareFunc::less, true};
  }

  bool one_in(int n) { return random_.integer(1, n) == 1; }

  DrawState next_state() {
    DrawState state = plain_;
    if (one_in(2)) state.depth.func = CompareFunc::less_equal;
    if (one_in(8)) state.depth.func = CompareFunc::greater;
    if (one_in(8)) state.depth.write = false;
    if (one_in(8)) state.blend = {true, BlendFactor::one, BlendFactor::one};
    if (one_in(8)) state.alpha_test = {true, CompareFunc::greater, 0.25f};
    if (one_in(6)) {
      state.polygon.offset_fill = true;
      state.polygon.offset_factor = random_.real(-1, 1), state.polygon.offset_units = random_.real(-9, 9);
    }
    if (one_in(8)) {
      state.raster.scissor_test = true;
      state.raster.scissor = {11, 9, 11 + static_cast<int>(random_.integer(1, 80)), 60};
    }
    return state;
  }

  // Small ones, but for a few, around places that are drawn on again and again.
  std::vector<Vertex> next_corners() {
    const float layer = static_cast<float>(random_.integer(-3, 3)) / 8;
    const bool level = one_in(2), cut = one_in(12);
    const int64_t x0 = random_.integer(0, kWidth - 20), y0 = random_.integer(0, kHeight - 20);
    std::vector<Vertex> corners;
    for (auto n = random_.integer(1, 600); n > 0; --n) {
      const int64_t reach = one_in(60) ? 40 * 256 : random_.integer(256, 8 * 256);
      const int64_t x = (x0 + random_.integer(0, 40)) * 256, y = (y0 + random_.integer(0, 40)) * 256;
      const float z = depth_near(cut && one_in(20) ? -0.999f : layer);
      const Color color = some_color();
      for (int k = 0; k < 3; ++k) {
        const float slope = level ? 0 : random_.real(-1, 1) / 64;
        corners.push_back(snapped_vertex(x + random_.integer(-reach, reach),
                                         y + random_.integer(-reach, reach), kViewport, z + slope, color));
      }
    }
    return corners;
  }

 private:
  // Most within some steps of 2^-24 of the layer.
  float depth_near(float layer) {
    if (one_in(4)) return layer + random_.real(-0.3f, 0.3f);
    return layer + static_cast<float>(random_.integer(-6, 6)) * 0x1p-23f;
  }
  Color some_color() {
    const auto channel = [&] { return random_.real(0, 1); };
    const float r = channel(), g = channel(), b = channel();
    return {r, g, b, channel()};
  }

  Random random_;
  DrawState plain_;
};

// `at_once`: else each few triangles are read back, so that nobody looks up how deep they are.
Picture draw_stream(uint64_t seed, bool fuse, bool at_once, int threads) {
  Stream stream(seed);
  Canvas canvas(kWidth, kHeight, threads, ColorFormat::rgba8, fuse);
  canvas.clear({0.1f, 0.2f, 0.3f, 0.4f}, 1);
  for (int i = 0; i < 12; ++i) {
    const DrawState state = stream.next_state();
    const std::vector<Vertex> corners = stream.next_corners();
    if (stream.one_in(6)) canvas.clear({0, 0, 0, 0}, 0.5 + i / 64.0);
    const std::span<const Vertex> all(corners);
    const size_t step = at_once ? all.size() : 3 * kFew;
    for (size_t at = 0; at < all.size(); at += step) {
      canvas.draw(state, Primitive::triangles, all.subspan(at, std::min(step, all.size() - at)));
      if (!at_once) canvas.read({0, 0, 1, 1});
    }
  }
  return canvas.read();
}

TEST(HiddenTriangles, LeaveNothingOut) {
  const uint64_t seeds = long_tests() ? 400 : 40;
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    const Picture reference = [&] {
      const IsaScope scope("scalar");
      return draw_stream(seed, false, false, 1);
    }();
    for (const std::string& isa : isa_levels()) {
      const IsaScope scope(isa);
      for (int threads : {1, 2})
        ASSERT_EQ(first_difference(reference, draw_stream(seed, true, true, threads)), "")
            << "seed " << seed << " on " << isa << " with " << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace halfspace::test
