// Making contexts current, which buffers are drawn to, and what a flush tells the drawable.
#include <cstdlib>
#include <thread>

#include "recording_device.h"
#include "state_fixture.h"

namespace halfspace::state {
namespace {

using raster::recorded_draws;

class DoubleBufferedTest : public StateTest {
 protected:
  DoubleBufferedTest() : StateTest(double_buffered()) { recorded_draws.clear(); }
  std::vector<raster::Framebuffer*> targets_of_a_rectangle() {
    recorded_draws.clear();
    op::rect(*context, 0, 0, 1, 1);
    flush_vertices(*context);
    std::vector<raster::Framebuffer*> targets;
    for (const auto& draw : recorded_draws) targets.push_back(draw.target);
    return targets;
  }
};

TEST_F(DoubleBufferedTest, DrawBufferChoosesTheTargets) {
  using Targets = std::vector<raster::Framebuffer*>;
  raster::Framebuffer *front = &drawable.front(), *back = &drawable.back();
  const std::pair<GLenum, Targets> cases[] = {
      {GL_NONE, {}},
      {GL_FRONT_LEFT, {front}},
      {GL_BACK_LEFT, {back}},
      {GL_FRONT, {front}},
      {GL_BACK, {back}},
      {GL_LEFT, {front, back}},
      {GL_FRONT_AND_BACK, {front, back}},
  };
  EXPECT_EQ(targets_of_a_rectangle(), Targets{back});
  for (const auto& [mode, targets] : cases) {
    op::draw_buffer(*context, mode);
    EXPECT_EQ(op::get_error(*context), GLenum(GL_NO_ERROR));
    EXPECT_EQ(targets_of_a_rectangle(), targets) << std::hex << mode;
  }
}

TEST_F(DoubleBufferedTest, ReadBufferChoosesTheSource) {
  EXPECT_EQ(read_framebuffer(*context), &drawable.back());
  op::read_buffer(*context, GL_FRONT_LEFT);
  EXPECT_EQ(read_framebuffer(*context), &drawable.front());
  op::read_buffer(*context, GL_LEFT);
  EXPECT_EQ(read_framebuffer(*context), &drawable.front());
}

TEST_F(DoubleBufferedTest, FlushNamesTheBufferDrawnTo) {
  op::flush(*context);
  EXPECT_EQ(drawable.finished, std::vector{&drawable.back()});
  drawable.finished.clear();
  op::draw_buffer(*context, GL_FRONT_AND_BACK);  // brings the old buffer up to date first
  EXPECT_EQ(drawable.finished, std::vector{&drawable.back()});
  op::finish(*context);
  EXPECT_EQ(drawable.finished, (std::vector{&drawable.back(), &drawable.front(), &drawable.back()}));
}

TEST(MakeCurrent, SizesTheViewportOnceOnly) {
  MemoryDrawable small({}, 10, 20), large({}, 300, 200);
  Context context({}, nullptr);
  make_current(&context, &small);
  EXPECT_EQ(context.viewport.width, 10);
  EXPECT_EQ(context.scissor.height, 20);
  make_current(&context, &large);
  EXPECT_EQ(context.viewport.width, 10);
  EXPECT_EQ(context.drawable, &large);
  make_current(nullptr, nullptr);
}

TEST(MakeCurrent, ReleasingFinishesAndForgetsTheDrawable) {
  MemoryDrawable drawable({}, 10, 20);
  Context context({}, nullptr);
  make_current(&context, &drawable);
  EXPECT_EQ(current_binding.context, &context);
  EXPECT_EQ(current_binding.table, &kExecuteTable);
  make_current(nullptr, nullptr);
  EXPECT_EQ(drawable.finished.size(), 1u);
  EXPECT_EQ(context.drawable, nullptr);
  EXPECT_EQ(current_binding.context, nullptr);
  EXPECT_EQ(current_binding.table, &kNoContextTable);
  recorded_draws.clear();
  op::rect(context, 0, 0, 1, 1);  // no drawable: nothing to draw on
  EXPECT_TRUE(recorded_draws.empty());
}

TEST(MakeCurrent, BeginSurvivesBeingReleased) {
  MemoryDrawable drawable({}, 10, 20);
  Context a({}, nullptr), b({}, nullptr);
  make_current(&a, &drawable);
  op::begin(a, GL_POINTS);
  make_current(&b, &drawable);
  EXPECT_EQ(current_binding.table, &kExecuteTable);
  make_current(&a, &drawable);
  EXPECT_EQ(current_binding.table, &kInsideBeginEndTable);
  make_current(nullptr, nullptr);
}

TEST(MakeCurrent, EachThreadHasItsOwn) {
  MemoryDrawable drawable({}, 10, 20), other_drawable({}, 30, 40);
  Context context({}, nullptr), other({}, nullptr);
  make_current(&context, &drawable);
  std::thread([&] {
    EXPECT_EQ(current_binding.context, nullptr);
    EXPECT_EQ(current_binding.table, &kNoContextTable);
    make_current(&other, &other_drawable);
    op::color(other, 0, 0, 0, 0);
    make_current(nullptr, nullptr);
  }).join();
  EXPECT_EQ(current_binding.context, &context);
  EXPECT_EQ(context.current.color[0], 1);
  make_current(&other, &other_drawable);  // on this thread now
  EXPECT_EQ(other.current.color[0], 0);
  EXPECT_EQ(other.viewport.width, 30);
  make_current(nullptr, nullptr);
}

TEST(MakeCurrent, DestroyingTheCurrentContextReleasesIt) {
  MemoryDrawable drawable({}, 10, 20);
  auto context = std::make_unique<Context>(VisualConfig{}, nullptr);
  make_current(context.get(), &drawable);
  context.reset();
  EXPECT_EQ(current_binding.context, nullptr);
  EXPECT_EQ(current_binding.table, &kNoContextTable);
}

TEST(Derive, VisualsWithoutAlphaOrDepth) {
  VisualConfig config;
  config.alpha_bits = config.depth_bits = 0;
  Context context(config, nullptr);
  op::enable(context, GL_DEPTH_TEST);
  op::blend_func(context, GL_DST_ALPHA, GL_ONE_MINUS_DST_ALPHA);
  const auto state = derive(context);
  EXPECT_FALSE(state->depth.test);
  EXPECT_EQ(state->blend.src, raster::BlendFactor::one);
  EXPECT_EQ(state->blend.dst, raster::BlendFactor::zero);
}

TEST(Derive, ScissorSaturates) {
  Context context({}, nullptr);
  op::scissor(context, INT32_MAX - 1, -5, INT32_MAX, 10);
  const auto state = derive(context);
  EXPECT_EQ(state->raster.scissor, (raster::Rect{INT32_MAX - 1, -5, INT32_MAX, 5}));
}

TEST(Derive, AccuracyComesFromTheEnvironment) {
  const std::pair<const char*, raster::Accuracy> cases[] = {{"draft", raster::Accuracy::draft},
                                                            {"exact", raster::Accuracy::exact},
                                                            {"standard", raster::Accuracy::standard},
                                                            {"nonsense", raster::Accuracy::standard}};
  for (const auto& [value, accuracy] : cases) {
    setenv("HALFSPACE_ACCURACY", value, 1);
    Context context({}, nullptr);
    EXPECT_EQ(derive(context)->accuracy, accuracy) << value;
  }
  unsetenv("HALFSPACE_ACCURACY");
}

}  // namespace
}  // namespace halfspace::state
