// Effects on demand, by the statistics: an effect that is off does not run on a single fragment, one that is
// on runs on those it is called for, and counting changes no byte.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <memory>
#include <string>

#include "tests/support/canvas.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 128, kCovered = 64 * 128;  // the left half

struct Metered {
  explicit Metered(bool meter) : framebuffer(kSize, kSize, ColorFormat::rgba8), device(options(meter)) {
    device.begin_pass(&framebuffer);
    ClearCommand clear;
    clear.color = clear.depth = clear.stencil = true;
    device.clear(clear);
  }
  static DeviceOptions options(bool meter) {
    DeviceOptions options;
    options.threads = 2;
    options.meter = meter;
    return options;
  }
  void draw(const DrawState& state) {
    constexpr std::array<float, 12> kPositions{-1, -1, -0.5f, 0, -1, -0.5f, 0, 1, -0.5f, -1, 1, -0.5f};
    DrawPacket packet;
    packet.state = std::make_shared<const DrawState>(state);
    packet.primitive = Primitive::quads;
    packet.batch.position = {kPositions.data(), 3 * sizeof(float), 3};
    packet.batch.count = packet.index_count = 4;
    device.draw(packet);
    device.finish();
  }
  // Fragments over all stages whose name begins so.
  uint64_t fragments(const std::string& name) const {
    uint64_t sum = 0;
    for (const StageCount& stage : device.statistics().stages)
      if (stage.name.starts_with(name)) sum += stage.fragments;
    return sum;
  }
  std::vector<uint8_t> picture() {
    std::vector<uint8_t> rgba(size_t{kSize} * kSize * 4);
    device.read_color({0, 0, kSize, kSize}, rgba.data());
    return rgba;
  }

  Framebuffer framebuffer;
  Device device;
};

struct Effect {
  const char* stage;
  std::function<void(DrawState&)> turn_on;
};

std::vector<Effect> effects() {
  return {{"depth", [](DrawState& s) { s.depth.test = true; }},
          {"stencil", [](DrawState& s) { s.stencil.test = true, s.stencil.depth_pass = StencilOp::invert; }},
          {"fog", [](DrawState& s) { s.fog.enabled = true; }},
          {"blend",
           [](DrawState& s) {
             s.blend = {true, BlendFactor::src_alpha, BlendFactor::one};
           }},
          {"logic_op",
           [](DrawState& s) {
             s.logic_op = {true, LogicOp::xor_};
           }},
          {"alpha_test", [](DrawState& s) {
             s.alpha_test = {true, CompareFunc::less, 2};
           }}};
}

TEST(StageMeter, NothingIsCountedUnlessAskedFor) {
  Metered plain(false);
  plain.draw(plain_state(kSize, kSize));
  EXPECT_TRUE(plain.device.statistics().stages.empty());
  EXPECT_EQ(plain.device.statistics().vertex_nanoseconds, 0u);
}

TEST(StageMeter, EffectsThatAreOffDoNotRun) {
  Metered plain(true);
  plain.draw(plain_state(kSize, kSize));
  for (const Effect& effect : effects()) EXPECT_EQ(plain.fragments(effect.stage), 0u) << effect.stage;
  EXPECT_EQ(plain.fragments("write"), uint64_t{kCovered});
}

TEST(StageMeter, AnEffectThatIsOnRunsOnEveryFragment) {
  for (const Effect& effect : effects()) {
    Metered one(true), uncounted(false);
    DrawState state = plain_state(kSize, kSize);
    effect.turn_on(state);
    one.draw(state);
    uncounted.draw(state);
    EXPECT_EQ(one.fragments(effect.stage), uint64_t{kCovered}) << effect.stage;
    EXPECT_EQ(one.picture(), uncounted.picture()) << effect.stage;
  }
}

TEST(StageMeter, VertexWorkIsCounted) {
  Metered lit(true);
  DrawState state = plain_state(kSize, kSize);
  lit.draw(state);
  EXPECT_EQ(lit.device.statistics().lit_vertices, 0u);
  state.lighting.enabled = true;
  state.tex_gen.coord[0].mode = TexGenMode::object_linear;
  lit.draw(state);
  EXPECT_EQ(lit.device.statistics().lit_vertices, 4u);
  EXPECT_EQ(lit.device.statistics().generated_vertices, 4u);
}

}  // namespace
}  // namespace halfspace::test
