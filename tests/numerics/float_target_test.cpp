// Framebuffers of floats: the same picture before it is rounded to bytes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/support/canvas.h"
#include "tests/support/scenes.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 130;

std::vector<float> read_floats(Canvas& canvas) {
  std::vector<float> values(size_t(4 * canvas.width() * canvas.height()));
  canvas.device().read_color_float({0, 0, canvas.width(), canvas.height()}, values.data());
  return values;
}

std::vector<float> draw_floats(const Scene& scene, int threads) {
  Canvas canvas(kSize, kSize, threads, ColorFormat::rgba32f);
  draw_scene(canvas, scene);
  return read_floats(canvas);
}

TEST(FloatTarget, EveryInstructionSetAndThreadCount) {
  for (const Scene& scene : scenes(kSize)) {
    const std::vector<float> reference = [&] {
      const IsaScope scope("scalar");
      return draw_floats(scene, 1);
    }();
    for (const std::string& isa : isa_levels()) {
      const IsaScope scope(isa);
      for (int threads : {1, 3}) {
        const std::vector<float> values = draw_floats(scene, threads);
        // Bits, not values: 0 and -0 differ, NaN equals itself.
        EXPECT_EQ(0, std::memcmp(values.data(), reference.data(), values.size() * sizeof(float)))
            << scene.name << " on " << isa << " with " << threads << " threads";
      }
    }
  }
}

// Without blending a byte is its float, rounded.
TEST(FloatTarget, BytesAreTheFloatsRounded) {
  for (const Scene& scene : scenes(kSize)) {
    bool blends = false;
    for (const SceneDraw& draw : scene.draws) blends = blends || draw.state.blend.enabled;
    if (blends) continue;
    const std::vector<float> floats = draw_floats(scene, 1);
    Canvas bytes(kSize, kSize);
    draw_scene(bytes, scene);
    const Picture picture = bytes.read();
    for (size_t i = 0; i < floats.size(); ++i) {
      ASSERT_LE(std::fabs(double(floats[i]) * 255 - picture.rgba[i]), 0.5 + 1e-4)
          << scene.name << ", pixel " << i / 4 % kSize << ", " << i / 4 / kSize << ", component " << i % 4;
    }
  }
}

TEST(FloatTarget, ClearKeepsItsColour) {
  Canvas canvas(9, 5, 1, ColorFormat::rgba32f);
  const Color color{0.1f, 0.123456789f, 0.9f, 0.75f};
  canvas.clear(color);
  const std::vector<float> values = read_floats(canvas);
  for (size_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], (&color.r)[i % 4]);
}

// A colour passes the pipeline within two roundings.
TEST(FloatTarget, DrawnColourIsKept) {
  Canvas canvas(9, 5, 1, ColorFormat::rgba32f);
  const Color color{0.1f, 0.123456789f, 0.9f, 0.75f};
  canvas.draw_plain(plain_state(16, 16), Primitive::quads, snapped_quad(0, 0, 4096, 4096, 16), color);
  const std::vector<float> values = read_floats(canvas);
  for (size_t i = 0; i < values.size(); ++i) ASSERT_NEAR(values[i], (&color.r)[i % 4], 2e-7f);
}

// Each fragment adds to what is there, exactly while the sums are short binary fractions.
TEST(FloatTarget, BlendsWithoutRoundingToBytes) {
  Canvas canvas(9, 5, 1, ColorFormat::rgba32f);
  DrawState state = plain_state(16, 16);
  state.blend = {true, BlendFactor::one, BlendFactor::one};
  for (int i = 0; i < 100; ++i) {
    canvas.draw_plain(state, Primitive::quads, snapped_quad(0, 0, 4096, 4096, 16), {0x1p-10f, 0x1p-9f, 0, 0});
  }
  const std::vector<float> values = read_floats(canvas);
  for (size_t i = 0; i < values.size(); i += 4) {
    ASSERT_NEAR(values[i], 100 * 0x1p-10f, 1e-5f);
    ASSERT_NEAR(values[i + 1], 100 * 0x1p-9f, 1e-5f);
  }
}

}  // namespace
}  // namespace halfspace::test
