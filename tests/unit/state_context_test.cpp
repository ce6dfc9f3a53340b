// Making contexts current, which buffers are drawn to, and what a flush tells the drawable.
#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <string>
#include <thread>

#include "recording_device.h"
#include "state_fixture.h"

namespace halfspace::state {
namespace {

using raster::recorded_draws;

class DoubleBufferedTest : public StateTest {
 protected:
  DoubleBufferedTest() : StateTest(double_buffered()) { recorded_draws.clear(); }
  // Planes a rectangle is drawn to.
  int targets_of_a_rectangle() {
    recorded_draws.clear();
    op::rect(*context, 0, 0, 1, 1);
    flush_vertices(*context);
    EXPECT_EQ(recorded_draws.size(), 1u);
    EXPECT_EQ(recorded_draws.back().target, &drawable.framebuffer(0));
    return recorded_draws.back().state->color_targets;
  }
};

constexpr int kBack = raster::kBackPlane, kFront = raster::kFrontPlane;

TEST_F(DoubleBufferedTest, DrawBufferChoosesTheTargets) {
  // GL_NONE too is drawn: depth and stencil go on.
  const std::pair<GLenum, int> cases[] = {
      {GL_NONE, 0},
      {GL_FRONT_LEFT, kFront},
      {GL_BACK_LEFT, kBack},
      {GL_FRONT, kFront},
      {GL_BACK, kBack},
      {GL_LEFT, kFront | kBack},
      {GL_FRONT_AND_BACK, kFront | kBack},
  };
  EXPECT_EQ(targets_of_a_rectangle(), kBack);
  EXPECT_EQ(drawable.asked, kBack);
  for (const auto& [mode, targets] : cases) {
    op::draw_buffer(*context, mode);
    EXPECT_EQ(op::get_error(*context), GLenum(GL_NO_ERROR));
    EXPECT_EQ(targets_of_a_rectangle(), targets) << std::hex << mode;
    EXPECT_EQ(drawable.asked & targets, targets);
  }
}

TEST_F(DoubleBufferedTest, ReadBufferChoosesTheSource) {
  EXPECT_EQ(read_plane(*context), kBack);
  op::read_buffer(*context, GL_FRONT_LEFT);
  EXPECT_EQ(read_plane(*context), kFront);
  EXPECT_EQ(drawable.asked & kFront, 0);
  read_framebuffer(*context);
  EXPECT_EQ(drawable.asked & kFront, kFront);
  op::read_buffer(*context, GL_LEFT);
  EXPECT_EQ(read_plane(*context), kFront);
}

TEST_F(DoubleBufferedTest, FlushNamesThePlanesDrawnTo) {
  op::flush(*context);
  EXPECT_EQ(drawable.finished, std::vector{kBack});
  drawable.finished.clear();
  op::draw_buffer(*context, GL_FRONT_AND_BACK);  // brings the old buffer up to date first
  EXPECT_EQ(drawable.finished, std::vector{kBack});
  op::finish(*context);
  EXPECT_EQ(drawable.finished, (std::vector{kBack, kFront | kBack}));
}

// A pixmap has no back buffer, whatever the context's visual has.
TEST(Planes, ADrawableOfOnePlaneServesEitherName) {
  MemoryDrawable drawable({}, 10, 20);
  Context context(double_buffered(), nullptr);
  make_current(&context, &drawable);
  for (const GLenum mode : std::initializer_list<GLenum>{GL_FRONT, GL_BACK, GL_FRONT_AND_BACK}) {
    op::draw_buffer(context, mode);
    EXPECT_EQ(draw_planes(context), kBack) << std::hex << mode;
  }
  op::read_buffer(context, GL_FRONT);
  EXPECT_EQ(read_plane(context), kBack);
  make_current(nullptr, nullptr);
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
  for (const auto& [value, level] : {std::pair("draft", raster::Level::draft),
                                     {"exact", raster::Level::exact},
                                     {"standard", raster::Level::standard},
                                     {"", raster::Level::standard}}) {
    setenv("HALFSPACE_ACCURACY", value, 1);
    Context context({}, nullptr);
    EXPECT_EQ(derive(context)->accuracy, raster::Accuracy::all(level)) << value;
  }
  unsetenv("HALFSPACE_ACCURACY");
}

TEST(Derive, NonsenseForAccuracyIsSaidOnceAndLeavesStandard) {
  setenv("HALFSPACE_ACCURACY", "exact,filter=sharp", 1);
  testing::internal::CaptureStderr();
  Context context({}, nullptr);
  const std::string said = testing::internal::GetCapturedStderr();
  unsetenv("HALFSPACE_ACCURACY");
  EXPECT_EQ(derive(context)->accuracy, raster::Accuracy());
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  EXPECT_NE(said.find("HALFSPACE_ACCURACY is 'exact,filter=sharp'"), said.npos) << said;
}

}  // namespace
}  // namespace halfspace::state
