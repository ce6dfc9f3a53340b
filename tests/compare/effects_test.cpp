// What `halfspace cost --effects` reads from the statistics, and what it makes of them.
#include "compare/effects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace halfspace::compare {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kLog =
    "GL_RENDERER  Halfspace\n"
    "halfspace: picture: 10 draws, 6838 vertices in 0.286 ms (688 lit, 0 with generated coordinates), 12672 "
    "triangles "
    "(8323 culled, 0 clipped), 234251 fragments (165 in double)\n"
    "  depth_less                       234251 fragments     0.170 ms    0.73 ns each\n"
    "  fog_perspective                     165 fragments     0.007 ms   44.57 ns each\n"
    "1     everything         12672      2.602      1.853\n"
    "halfspace: picture: 1 draws, 1 vertices in 0.286 ms (0 lit, 0 with generated coordinates), 1 triangles "
    "(0 culled, "
    "0 clipped), 3 fragments (0 in double)\n"
    "  write_rgba8                           3 fragments     0.170 ms    0.73 ns each\n";

TEST(StatisticsOf, TakesTheFirstPicture) {
  const PictureStatistics statistics = statistics_of(kLog);
  EXPECT_EQ(statistics.vertices, 6838u);
  EXPECT_EQ(statistics.lit_vertices, 688u);
  EXPECT_EQ(statistics.fragments, 234251u);
  ASSERT_EQ(statistics.stages.size(), 2u);
  EXPECT_EQ(statistics.stages[1].name, "fog_perspective");
  EXPECT_EQ(statistics.stages[1].fragments, 165u);
  EXPECT_THROW(statistics_of("nothing\n"), std::runtime_error);
}

// Steps as the program has them, with the stages that belong to them.
EffectsResult steps() {
  EffectsResult result;
  PictureStatistics so_far;
  so_far.fragments = 1000;
  for (const auto& [name, stage] :
       std::initializer_list<std::pair<const char*, const char*>>{{"flat", "color_constant"},
                                                                  {"smooth", "color_affine"},
                                                                  {"depth", "depth_less"},
                                                                  {"texture", "sample_nearest"},
                                                                  {"perspective", "coord_perspective"},
                                                                  {"filter", "sample_linear"},
                                                                  {"mipmap", "lambda"},
                                                                  {"light", ""},
                                                                  {"fog", "fog_exp2"},
                                                                  {"blend", "blend_rgba8"},
                                                                  {"stencil", "stencil_test"},
                                                                  {"alpha_test", "alpha_test"}}) {
    if (*stage) so_far.stages.push_back({stage, 500});
    if (std::string(name) == "light") so_far.lit_vertices = 77;
    EffectStep step;
    step.name = name;
    step.statistics = so_far;
    result.steps.push_back(step);
  }
  result.idle.name = "idle";
  result.idle.statistics.stages = {{"color_constant", 1000}};
  return result;
}

TEST(FindStages, GivesEachEffectItsOwn) {
  EffectsResult result = steps();
  find_stages(result);
  EXPECT_EQ(result.done_while_off, 0u);
  EXPECT_THAT(result.steps[8].stages, ElementsAre("fog_exp2"));
  EXPECT_THAT(result.steps[6].stages, ElementsAre("lambda"));
  EXPECT_THAT(result.steps[0].stages, ElementsAre());
}

TEST(FindStages, CountsWhatIsDoneWhileAnEffectIsOff) {
  EffectsResult result = steps();
  result.steps[1].statistics.stages.push_back({"fog_exp2", 30});
  result.steps[2].statistics.lit_vertices = 5;
  result.idle.statistics.stages.push_back({"alpha_test", 7});
  result.idle.statistics.lit_vertices = 1;
  find_stages(result);
  EXPECT_EQ(result.done_while_off, 43u);
  EXPECT_THAT(to_text(result), HasSubstr("off: 43\n"));
}

TEST(FindStages, MissesNoStage) {
  EffectsResult result = steps();
  for (EffectStep& step : result.steps)
    for (StageUse& stage : step.statistics.stages)
      if (stage.name == "fog_exp2") stage.name = "mist";
  EXPECT_THROW(find_stages(result), std::runtime_error);
}

TEST(EffectsChart, HasARowForEachStep) {
  EffectsResult result = steps();
  for (size_t i = 0; i < result.steps.size(); ++i)
    result.steps[i].ours = result.steps[i].mesa = summarize({static_cast<double>(i + 1)});
  const std::string svg = effects_chart(result);
  EXPECT_THAT(svg, HasSubstr(">flat</text>"));
  EXPECT_THAT(svg, HasSubstr(">+ alpha_test</text>"));
  EXPECT_THAT(svg, HasSubstr("12.00 ms  (+1.00)"));
}

}  // namespace
}  // namespace halfspace::compare
