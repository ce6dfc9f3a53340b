// Texture environments over all base formats (spec 3.8.13, tables 3.22 and 3.23).
#include <gtest/gtest.h>

#include "tests/oracle/fragment.h"
#include "tests/support/canvas.h"
#include "tests/support/textures.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kCells = 16;  // a texel a pixel, kCells x kCells of them

std::array<uint8_t, 4> random_bytes(Random& random) {
  std::array<uint8_t, 4> bytes;
  // Each component is an end of the range one time in four.
  for (uint8_t& b : bytes) {
    const int64_t kind = random.integer(0, 7);
    b = kind == 0 ? uint8_t{0} : kind == 1 ? uint8_t{255} : uint8_t(random.bits());
  }
  return bytes;
}

Color color_of(const std::array<uint8_t, 4>& b) {
  return {float(b[0]) / 255, float(b[1]) / 255, float(b[2]) / 255, float(b[3]) / 255};
}

oracle::Rgba rgba_of(const std::array<uint8_t, 4>& b) {
  return {b[0] / 255.0L, b[1] / 255.0L, b[2] / 255.0L, b[3] / 255.0L};
}

void expect_environment(EnvMode mode, BaseFormat format, Filter filter, bool one_color, uint64_t seed) {
  Random random(seed);
  TestTexture texture(format);
  texture.add_noise(random, kCells, kCells);
  const Sampler sampler = sampler_of(filter, Wrap::repeat);
  const oracle::Texture reference = texture.reference(sampler);
  const auto fragment = random_bytes(random), constant = random_bytes(random);
  DrawState state = plain_state(kCells, kCells);
  state.texture.view = texture.view(sampler);
  state.texture.env = mode;
  state.texture.env_color = color_of(constant);
  std::vector<Vertex> quad = snapped_quad(0, 0, 256 * kCells, 256 * kCells, kCells, 0, color_of(fragment));
  quad[1].s = quad[2].s = quad[2].t = quad[3].t = 1;
  if (!one_color) {
    // Another triangle elsewhere, of another colour: the colour varies over the batch.
    quad.insert(quad.end(), quad.begin(), quad.begin() + 4);
    for (size_t i = 4; i < 8; ++i) quad[i].x += 2, quad[i].color = color_of(constant);
  }
  Canvas canvas(kCells, kCells);
  canvas.draw(state, Primitive::quads, quad);
  const Picture picture = canvas.read();
  for (int y = 0; y < kCells; ++y) {
    for (int x = 0; x < kCells; ++x) {
      const oracle::Rgba exact = oracle::environment(mode, format, rgba_of(fragment),
                                                     reference.levels[0].texel(x, y), rgba_of(constant));
      for (size_t c = 0; c < 4; ++c) {
        ASSERT_LE(std::fabs(double(oracle::level_of(exact[c])) - picture.pixel(x, y)[c]), 0.55)
            << "mode " << int(mode) << ", format " << int(format) << ", filter " << int(filter)
            << ", component " << c << ": exact " << double(exact[c] * 255) << ", is "
            << int(picture.pixel(x, y)[c]);
      }
    }
  }
}

TEST(Environment, EveryModeAndFormat) {
  for (int mode = 0; mode < 4; ++mode) {
    for (int format = 0; format < 6; ++format) {
      const bool defined = EnvMode(mode) != EnvMode::decal || BaseFormat(format) == BaseFormat::rgb ||
                           BaseFormat(format) == BaseFormat::rgba;
      if (!defined) continue;
      for (Filter filter : {Filter::nearest, Filter::linear}) {
        for (bool one_color : {true, false}) {
          for (uint64_t seed = 0; seed < (long_tests() ? 200u : 8u); ++seed) {
            expect_environment(EnvMode(mode), BaseFormat(format), filter, one_color, seed);
            if (testing::Test::HasFatalFailure()) return;
          }
        }
      }
    }
  }
}

// White under MODULATE is the texture itself, and a white texture the colour itself, to the byte.
TEST(Environment, ModulatingByWhiteIsExact) {
  Random random(3);
  TestTexture noise, white;
  noise.add_noise(random, kCells, kCells);
  const uint8_t bytes[4] = {255, 255, 255, 255};
  white.add_color(kCells, kCells, bytes);
  for (Filter filter : {Filter::nearest, Filter::linear}) {
    const Sampler sampler = sampler_of(filter, Wrap::repeat);
    const oracle::Texture reference = noise.reference(sampler);
    DrawState state = plain_state(kCells, kCells);
    std::vector<Vertex> quad = snapped_quad(0, 0, 256 * kCells, 256 * kCells, kCells);
    quad[1].s = quad[2].s = quad[2].t = quad[3].t = 1;
    Canvas canvas(kCells, kCells);
    state.texture.view = noise.view(sampler);
    canvas.draw(state, Primitive::quads, quad);
    Picture picture = canvas.read();
    for (int y = 0; y < kCells; ++y) {
      for (int x = 0; x < kCells; ++x) {
        for (size_t c = 0; c < 4; ++c) {
          ASSERT_EQ(int(picture.pixel(x, y)[c]), std::lround(reference.levels[0].texel(x, y)[c] * 255));
        }
      }
    }
    state.texture.view = white.view(sampler);
    for (int byte = 0; byte < 256; ++byte) {
      const float c = float(byte) / 255;
      for (Vertex& v : quad) v.color = {c, c, c, c};
      canvas.draw(state, Primitive::quads, quad);
      picture = canvas.read();
      for (uint8_t p : picture.rgba) ASSERT_EQ(int(p), byte);
    }
  }
}

}  // namespace
}  // namespace halfspace::test
