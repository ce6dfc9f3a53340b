// The result of `halfspace cost`: what stands on the Pareto front, what becomes of it as text and picture.
#include "compare/cost.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "compare/cost_chart.h"
#include "compare/cost_scenes.h"

namespace halfspace::compare {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Value {
  const char* name;
  double ratio;
  uint64_t wrong;  // of 1000 pixels
};

CostPoint point_of(const Value& value) {
  CostPoint point;
  point.setting.name = value.name;
  for (const Setting& setting : our_settings())
    if (setting.name == value.name) point.setting = setting;
  point.ms = point.ratio = summarize({value.ratio});
  point.error.emplace();
  point.error->pixels = 1000;
  point.error->wrong = value.wrong;
  return point;
}

CostScene scene_of(const std::vector<Value>& values) {
  CostScene scene{"scene", {}};
  for (const Value& value : values) scene.points.push_back(point_of(value));
  return scene;
}

std::vector<std::string> front_of(const std::vector<Value>& values) {
  const CostScene scene = scene_of(values);
  std::vector<std::string> names;
  for (const CostPoint* point : pareto_front(scene)) names.push_back(point->setting.name);
  return names;
}

TEST(ParetoFront, HasWhatNoOtherBeats) {
  EXPECT_THAT(front_of({{"draft", 0.5, 100}, {"standard", 1, 10}, {"exact", 2, 0}, {"softpipe", 50, 20}}),
              ElementsAre("draft", "standard", "exact"));
  EXPECT_THAT(front_of({{"draft", 2, 100}, {"standard", 1, 10}, {"exact", 1.5, 10}}),
              ElementsAre("standard"));
  EXPECT_THAT(front_of({{"standard", 1, 10}, {"exact", 1, 0}}), ElementsAre("exact"));
}

TEST(ParetoFront, TakesTimesWithinTheNoiseAsTheSame) {
  EXPECT_THAT(front_of({{"fog draft", 0.99, 10}, {"standard", 1, 10}}), ElementsAre("standard"));
  EXPECT_THAT(front_of({{"fog draft", 0.9, 10}, {"standard", 1, 10}}), ElementsAre("fog draft"));
}

TEST(ParetoFront, LeavesOutWhatWasNotMeasured) {
  CostScene scene = scene_of({{"draft", 0.5, 100}, {"standard", 1, 0}});
  scene.points[0].error.reset();
  ASSERT_EQ(pareto_front(scene).size(), 1u);
  EXPECT_EQ(pareto_front(scene)[0]->setting.name, "standard");
}

CostResult two_scenes() {
  CostResult result;
  result.scenes = {scene_of({{"standard", 1, 10}, {"exact", 2, 0}}),
                   scene_of({{"standard", 1, 30}, {"exact", 8, 1}})};
  return result;
}

TEST(AllScenes, TakeTheGeometricMeanOfTheTimesAndAllPixels) {
  const CostScene all = all_scenes(two_scenes());
  EXPECT_NEAR(all.points[1].ratio.median, 4, 1e-12);
  EXPECT_EQ(all.points[0].error->wrong_percent(), 2);
  EXPECT_EQ(all.points[1].error->wrong, 1u);
}

TEST(CostText, HasARowForEachPoint) {
  const std::string csv = to_csv(two_scenes());
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  EXPECT_THAT(csv, HasSubstr("\"scene\",\"exact\",8,0,8,1000,1,"));
  EXPECT_THAT(to_text(two_scenes()), HasSubstr("not beaten in both time and error: [standard] [exact]"));
  EXPECT_EQ(to_json(two_scenes())["all"]["points"][1]["error"]["wrong"], 1);
}

TEST(CostChart, ShowsEveryLevelAndOtherRenderer) {
  const std::string svg = scene_chart(scene_of({{"standard", 1, 10}, {"softpipe", 20, 0}}));
  EXPECT_THAT(svg, testing::StartsWith("<svg "));
  EXPECT_THAT(svg, HasSubstr(">standard</text>"));
  EXPECT_THAT(svg, HasSubstr(">softpipe</text>"));
  EXPECT_THAT(axes_chart(scene_of({{"standard", 1, 10}, {"fog draft", 1, 20}, {"fog exact", 1, 0}})),
              HasSubstr(">fog</text>"));
}

TEST(Settings, TurnEachAxisBothWays) {
  std::set<std::string> values;
  for (const Setting& setting : our_settings()) {
    ASSERT_EQ(setting.environment.front().first, "HALFSPACE_ACCURACY");
    EXPECT_TRUE(values.insert(setting.environment.front().second).second) << setting.name;
  }
  EXPECT_TRUE(values.contains("exact"));
  EXPECT_TRUE(values.contains("standard,filter=draft"));
  EXPECT_TRUE(values.contains("standard,coverage=exact"));
}

TEST(Settings, AreNotTakenForAnother) {
  EXPECT_TRUE(is_renderer_of(standard_setting(), "Halfspace avx2"));
  EXPECT_FALSE(is_renderer_of(standard_setting(), "Halfspace oracle"));
  EXPECT_FALSE(is_renderer_of(standard_setting(), "llvmpipe (LLVM 15.0.6, 256 bits)"));
  EXPECT_TRUE(is_renderer_of(truth_setting(), "Halfspace oracle"));
  EXPECT_FALSE(is_renderer_of(truth_setting(), "Halfspace avx2"));
  EXPECT_TRUE(is_renderer_of(mesa_settings().back(), "softpipe"));
  EXPECT_FALSE(is_renderer_of(mesa_settings().back(), "llvmpipe (LLVM 15.0.6, 256 bits)"));
}

TEST(ChosenScenes, ByNumberRangeAndName) {
  CostOptions options;
  options.scenes = {"2-3", "terrain"};
  const std::vector<SceneGroup> groups = chosen_groups(options);
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_THAT(groups[0].arguments, ElementsAre("2", "3", "8"));
  EXPECT_THAT(groups[0].labels, ElementsAre("2 white shapes", "3 coloured solids", "8 terrain"));
  for (const char* wrong : {"0", "9", "3-2", "1-", "x", ""}) {
    options.scenes = {wrong};
    EXPECT_THROW(chosen_groups(options), std::runtime_error) << wrong;
  }
}

}  // namespace
}  // namespace halfspace::compare
