// The fuzzer's own parts: a judge that overlooks and a knife that cuts too much would make it useless.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "capture.h"
#include "maker.h"
#include "shrink.h"
#include "verdict.h"

namespace halfspace::fuzz {
namespace {

Picture plain(int width, int height, uint8_t level) {
  return {width, height, std::vector<uint8_t>(static_cast<size_t>(width * height * 4), level), {}};
}

void set(Picture& picture, int x, int y, uint8_t level) {
  for (int c = 0; c < 4; ++c) picture.rgba[static_cast<size_t>((y * picture.width + x) * 4 + c)] = level;
}

Outcome outcome(Picture picture) {
  Outcome result;
  result.picture = std::move(picture);
  result.depth.resize(result.picture.rgba.size() / 4, 0.5f);
  result.stencil.resize(result.depth.size(), 1);
  return result;
}

// Left of `edge` 10, else 200.
Picture halves(int edge) {
  Picture picture = plain(16, 8, 10);
  for (int y = 0; y < 8; ++y) {
    for (int x = edge; x < 16; ++x) set(picture, x, y, 200);
  }
  return picture;
}

TEST(Judge, LetsAnEdgeMoveByOnePixelOnly) {
  const Limits limits{2, 0};
  const Outcome reference = outcome(halves(8));
  for (int edge : {7, 8, 9})
    EXPECT_TRUE(judge(outcome(halves(edge)), reference, reference, limits).agrees) << edge;
  for (int edge : {6, 10})
    EXPECT_FALSE(judge(outcome(halves(edge)), reference, reference, limits).agrees) << edge;
}

TEST(Judge, CountsLevels) {
  const Outcome reference = outcome(plain(4, 4, 100));
  EXPECT_TRUE(judge(outcome(plain(4, 4, 103)), reference, reference, {3, 0}).agrees);
  EXPECT_FALSE(judge(outcome(plain(4, 4, 104)), reference, reference, {3, 0}).agrees);
  EXPECT_FALSE(judge(outcome(plain(4, 4, 96)), reference, reference, {3, 0}).agrees);
}

TEST(Judge, SeesWhatIsMissingAndWhatIsTooMuch) {
  const Picture empty = plain(8, 8, 50);
  Picture dot = empty;
  set(dot, 3, 5, 250);
  const Verdict missing = judge(outcome(empty), outcome(dot), outcome(dot), {3, 0});
  EXPECT_FALSE(missing.agrees);
  EXPECT_EQ(std::pair(missing.first_x, missing.first_y), std::pair(3, 5));
  EXPECT_EQ(missing.wrong, 1);
  EXPECT_FALSE(judge(outcome(dot), outcome(empty), outcome(empty), {3, 0}).agrees);
  EXPECT_TRUE(judge(outcome(dot), outcome(empty), outcome(empty), {3, 1}).agrees);
}

TEST(Judge, LeavesOpenWhatTheReferencesDoNotAgreeOn) {
  const Outcome ours = outcome(plain(4, 4, 100));
  EXPECT_TRUE(judge(ours, outcome(plain(4, 4, 0)), outcome(plain(4, 4, 200)), {3, 0}).agrees);
  EXPECT_FALSE(judge(ours, outcome(plain(4, 4, 198)), outcome(plain(4, 4, 200)), {3, 0}).agrees);
}

TEST(Judge, LooksAtDepthAndStencil) {
  const Outcome reference = outcome(plain(8, 8, 50));
  const Limits limits{2, 0};
  Outcome ours = reference;
  ours.depth[9] = 0.5f + 1.0f / 8192;
  EXPECT_TRUE(judge(ours, reference, reference, limits).agrees);
  ours.depth[9] = 0.5f + 1.0f / 2048;
  EXPECT_FALSE(judge(ours, reference, reference, limits).agrees);
  ours = reference;
  ours.stencil[9] = 2;
  EXPECT_FALSE(judge(ours, reference, reference, limits).agrees);
}

Capture capture(uint32_t mode, std::vector<uint32_t> words) {
  return {3, mode, GL_2D, static_cast<int32_t>(words.size()), std::move(words)};
}
Capture feedback(std::initializer_list<float> numbers) {
  std::vector<uint32_t> words;
  for (float number : numbers) words.push_back(std::bit_cast<uint32_t>(number));
  return capture(GL_FEEDBACK, std::move(words));
}

TEST(Captures, HitsHaveNamesAndDepths) {
  const Capture one = capture(GL_SELECT, {2, 1000, 2000, 7, 8});
  EXPECT_EQ(compare(one, capture(GL_SELECT, {2, 5000, 2000, 7, 8})), "");
  EXPECT_NE(compare(one, capture(GL_SELECT, {2, 1000, 2000, 7, 9})), "");
  EXPECT_NE(compare(one, capture(GL_SELECT, {2, 1000, 1u << 22, 7, 8})), "");
  EXPECT_NE(compare(one, capture(GL_SELECT, {})), "");
}

TEST(Captures, PolygonsMayBeCutOtherwise) {
  constexpr float kPolygon = GL_POLYGON_TOKEN, kPoint = GL_POINT_TOKEN;
  const Capture quad = feedback({kPolygon, 4, 0, 0, 20, 0, 20, 20, 0, 20, kPoint, 3, 4});
  const Capture halves =
      feedback({kPolygon, 3, 20, 0, 20, 20, 0, 20, kPolygon, 3, 0, 0, 20, 0, 0, 20, kPoint, 3, 4});
  EXPECT_EQ(compare(quad, halves), "");
  EXPECT_NE(compare(quad, feedback({kPolygon, 4, 0, 0, 20, 0, 20, 20, 0, 20, kPoint, 3, 4.25f})), "");
  EXPECT_NE(compare(quad, feedback({kPolygon, 4, 0, 0, 20, 0, 20, 20, 0, 20})), "");
  EXPECT_NE(compare(quad, feedback({kPolygon, 3, 0, 0, 20, 0, 20, 20, kPoint, 3, 4})), "half is missing");
  EXPECT_NE(compare(quad, feedback({kPolygon, 4, 0, 20, 20, 20, 20, 0, 0, 0, kPoint, 3, 4})), "turned over");
}

TEST(Judge, HoldsErrorsAgainstEachOther) {
  Outcome ours = outcome(plain(4, 4, 100)), theirs = ours;
  theirs.errors = {{7, GL_INVALID_ENUM}};
  EXPECT_FALSE(judge(ours, theirs, theirs, {}).agrees);
  ours.errors = {{7, GL_INVALID_VALUE}};
  EXPECT_FALSE(judge(ours, theirs, theirs, {}).agrees);
  ours.errors = {{7, GL_INVALID_ENUM}};
  EXPECT_TRUE(judge(ours, theirs, theirs, {}).agrees);
  ours.trouble = "ended by a signal";
  EXPECT_FALSE(judge(ours, theirs, theirs, {}).agrees);
}

TEST(Stream, ComesBackAsItWasSent) {
  for (uint64_t seed = 1; seed < 40; ++seed) {
    const Stream stream = make_stream(seed, {});
    EXPECT_EQ(deserialize(serialize(stream)), stream);
    EXPECT_EQ(make_stream(seed, {}), stream);
    EXPECT_TRUE(is_well_formed(stream)) << seed;
  }
}

TEST(Stream, SeedsDoNotRepeatEachOther) {
  std::vector<size_t> sizes;
  for (uint64_t seed = 1; seed <= 60; ++seed) sizes.push_back(serialize(make_stream(seed, {})).size());
  std::sort(sizes.begin(), sizes.end());
  EXPECT_GT(std::unique(sizes.begin(), sizes.end()) - sizes.begin(), 57);
}

TEST(Stream, EveryFeatureTakesPart) {
  std::vector<std::string> met;
  for (uint64_t seed = 1; seed < 400; ++seed) {
    for (const Call& call : make_stream(seed, {})) met.emplace_back(name_of(call.command));
  }
  for (const char* name :
       {"glBegin", "glDrawElements", "glFogi", "glLightfv", "glStencilOp", "glLogicOp", "glDrawPixels",
        "glCallLists", "glEvalMesh2", "glSelectBuffer", "glFeedbackBuffer", "glPushClientAttrib", "glIndexub",
        "glPushAttrib", "glAccum", "glCopyTexImage2D", "glTexGeni"})
    EXPECT_NE(std::find(met.begin(), met.end(), name), met.end()) << name;
}

TEST(Stream, PrintsAsC) {
  EXPECT_EQ(print_call({Command::glEnable, {GL_STENCIL_TEST}, {}}), "glEnable(GL_STENCIL_TEST);");
  EXPECT_EQ(print_call({Command::glBlendFunc, {GL_ONE, GL_ZERO}, {}}), "glBlendFunc(GL_ONE, GL_ZERO);");
  EXPECT_EQ(print_call({Command::glPolygonMode, {GL_FRONT, GL_LINE}, {}}),
            "glPolygonMode(GL_FRONT, GL_LINE);");
  EXPECT_EQ(print_call({Command::glLoadMatrixf, {0}, bytes_of(std::vector<float>{1, 0.5f})}),
            "glLoadMatrixf((const GLfloat[]){1,0.5f});");
  EXPECT_EQ(print_call({Command::glBitmap, {0, 0, 0, 0, 2, -1.5, 0}, {}}),
            "glBitmap(0, 0, 0, 0, 2, -1.5f, NULL);");
}

Call call(Command command) { return {command, {}, {}}; }

TEST(Shrink, FindsTheTwoCallsThatMatter) {
  Stream stream;
  for (int i = 0; i < 30; ++i) {
    stream.push_back({Command::glLineWidth, {double(i)}, {}});
    stream.push_back({Command::glBegin, {GL_LINE_STRIP}, {}});
    for (int k = 0; k < 3; ++k) stream.push_back({Command::glVertex2i, {0, 0}, {}});
    stream.push_back({Command::glIndexi, {double(i)}, {}});
    stream.push_back(call(Command::glEnd));
  }
  const auto fails = [](const Stream& candidate) {
    EXPECT_TRUE(is_well_formed(candidate));
    const auto has = [&](Command command, double value) {
      return std::count(candidate.begin(), candidate.end(), Call{command, {value}, {}}) > 0;
    };
    return has(Command::glLineWidth, 7) && has(Command::glIndexi, 21);
  };
  const Stream small = shrink(stream, fails, 10'000);
  EXPECT_EQ(small, (Stream{{Command::glLineWidth, {7}, {}}, {Command::glIndexi, {21}, {}}}));
}

TEST(Shrink, StopsWhenItIsTold) {
  int asked = 0;
  shrink(
      Stream(100, call(Command::glFlush)), [&](const Stream&) { return ++asked, false; }, 17);
  EXPECT_EQ(asked, 17);
}

}  // namespace
}  // namespace halfspace::fuzz
