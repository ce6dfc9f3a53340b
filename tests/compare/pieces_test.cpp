// Statistics, HTML, charts and child processes: small parts, values known from elsewhere.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "compare/bar_chart.h"
#include "compare/curve_chart.h"
#include "compare/dialogue.h"
#include "compare/html.h"
#include "compare/process.h"
#include "compare/statistics.h"

namespace halfspace::compare {
namespace {

using testing::HasSubstr;

TEST(Statistics, OddEvenAndSingle) {
  EXPECT_DOUBLE_EQ(summarize({3, 1, 2}).median, 2);
  EXPECT_DOUBLE_EQ(summarize({4, 1, 2, 3}).median, 2.5);
  EXPECT_DOUBLE_EQ(summarize({5}).median, 5);
  EXPECT_DOUBLE_EQ(summarize({5}).spread, 0);
  EXPECT_EQ(summarize({}).count, 0);
}

TEST(Statistics, SpreadIsOfTheMiddleHalf) {
  const Summary s = summarize({100, 90, 110, 100, 1000});
  EXPECT_DOUBLE_EQ(s.median, 100);
  EXPECT_DOUBLE_EQ(s.lowest, 90);
  EXPECT_DOUBLE_EQ(s.highest, 1000);
  EXPECT_DOUBLE_EQ(s.spread, 0.05);  // quartiles 100 and 110; the one wild run does not count
}

// A machine that is half as fast for some of the pairs.
TEST(Statistics, RatiosAreOfPairs) {
  const Summary s = paired_ratio({30, 60, 60, 30}, {10, 20, 20, 10});
  EXPECT_DOUBLE_EQ(s.median, 3);
  EXPECT_DOUBLE_EQ(s.spread, 0);
  EXPECT_EQ(s.count, 4);
  EXPECT_DOUBLE_EQ(paired_ratio({30, 60, 31}, {10, 20, 20}).median, 3);
}

TEST(Statistics, WhatHasNoPairIsLeftOut) {
  EXPECT_EQ(paired_ratio({1, 2, 3}, {1, 2}).count, 2);
  EXPECT_EQ(paired_ratio({1, 2}, {0, 2}).count, 1);
  EXPECT_EQ(paired_ratio({}, {}).count, 0);
}

ChildCommand shell(const std::string& script) {
  ChildCommand command;
  command.arguments = {"sh", "-c", script};
  return command;
}

TEST(Dialogue, AnswersInTurnHoweverTheBytesArrive) {
  Dialogue dialogue(
      shell("while read -r line; do printf 'you '; sleep 0.01; printf 'said %s\\n' \"$line\"; done"));
  EXPECT_EQ(dialogue.ask("one"), "you said one");
  EXPECT_EQ(dialogue.ask("two words"), "you said two words");
}

TEST(Dialogue, AChildThatEndsOrIsNotThereIsAnError) {
  Dialogue ends(shell("read -r line; echo last"));
  EXPECT_EQ(ends.ask("one"), "last");
  EXPECT_THROW(ends.ask("two"), std::runtime_error);
  ChildCommand missing;
  missing.arguments = {"there-is-no-such-program"};
  EXPECT_THROW(Dialogue(missing).ask("anyone?"), std::runtime_error);
}

std::string base64_of(std::string_view text) {
  return base64({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

// RFC 4648, section 10.
TEST(Html, Base64) {
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foo"), "Zm9v");
  EXPECT_EQ(base64_of("foob"), "Zm9vYg==");
  EXPECT_EQ(base64_of("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_of("\xff\xff\xfe"), "///+");
}

TEST(Html, FileNamesCannotBreakOut) {
  EXPECT_EQ(escape_html("a<b>&\"c\""), "a&lt;b&gt;&amp;&quot;c&quot;");
  EXPECT_THAT(figures_html({{"data:", "<script>"}}), testing::Not(HasSubstr("<script>")));
  EXPECT_THAT(page_html("<x>", ""), testing::Not(HasSubstr("<x>")));
}

TEST(CurveChart, PowersOfTenAreEvenlySpaced) {
  const std::string svg = to_svg({{"t", "x", "y", {{"a<", {{1, 1}, {10, 10}, {100, 100}, {0, 5}}}}}});
  double x[4], y[4];
  int points = 0;
  for (size_t at = 0; points < 4 && (at = svg.find("<circle", at)) != std::string::npos; ++at, ++points)
    ASSERT_EQ(std::sscanf(svg.c_str() + at, "<circle cx=\"%lf\" cy=\"%lf\"", &x[points], &y[points]), 2);
  ASSERT_EQ(points, 3);  // the fourth has no logarithm
  EXPECT_NEAR(x[2] - x[1], x[1] - x[0], 0.11);
  EXPECT_NEAR(y[2] - y[1], y[1] - y[0], 0.11);
  EXPECT_GT(x[1], x[0]);
  EXPECT_LT(y[1], y[0]);  // upwards
  EXPECT_THAT(svg, HasSubstr("a&lt;"));
}

TEST(BarChart, LengthsAreInProportion) {
  const BarChart chart{"t", "", 1, "", {{"a", 0.5, 0, true}, {"b<", 0.25, 0.3, false}}};
  const std::string svg = to_svg(chart);
  EXPECT_THAT(svg, HasSubstr("width=\"240.0\" height=\"18.0\""));
  EXPECT_THAT(svg, HasSubstr("width=\"120.0\" height=\"18.0\""));
  EXPECT_THAT(svg, HasSubstr("b&lt;"));
}

TEST(Process, HandsOverStatusAndSignals) {
  EXPECT_EQ(run_child({{"true"}, {}, {}, {}}).exit_code, 0);
  EXPECT_EQ(run_child({{"sh", "-c", "exit 42"}, {}, {}, {}}).exit_code, 42);
  const ChildResult killed = run_child({{"sh", "-c", "kill -TERM $$"}, {}, {}, {}});
  EXPECT_EQ(killed.signal, SIGTERM);
  EXPECT_EQ(killed.exit_code, 128 + SIGTERM);
}

TEST(Process, SaysWhyItCouldNotStart) {
  try {
    run_child({{"halfspace-no-such-program"}, {}, {}, {}});
    FAIL() << "started a program that is not there";
  } catch (const StartError& error) {
    EXPECT_EQ(shell_status(error), 127);
  }
  try {
    run_child({{"/etc/passwd"}, {}, {}, {}});
    FAIL() << "started a file that is no program";
  } catch (const StartError& error) {
    EXPECT_EQ(shell_status(error), 126);
  }
}

std::string output_of(ChildCommand command) {
  command.output = testing::TempDir() + "halfspace_process_" + std::to_string(getpid());
  EXPECT_EQ(run_child(command).exit_code, 0);
  std::ifstream file(command.output);
  std::ostringstream text;
  text << file.rdbuf();
  std::filesystem::remove(command.output);
  return text.str();
}

TEST(Process, EnvironmentIsSetAndUnset) {
  setenv("HALFSPACE_TEST_KEEP", "kept", 1);
  setenv("HALFSPACE_TEST_GONE", "old", 1);
  const ChildCommand command{
      {"sh", "-c",
       "echo $HALFSPACE_TEST_KEEP-${HALFSPACE_TEST_GONE-unset}-$HALFSPACE_TEST_NEW; echo err >&2"},
      {{"HALFSPACE_TEST_GONE", ""}, {"HALFSPACE_TEST_NEW", "a b"}},
      {},
      {}};
  EXPECT_EQ(output_of(command), "kept-unset-a b\nerr\n");
}

TEST(Process, IsPinned) {
  const std::vector<int> cores = available_cores();
  ASSERT_FALSE(cores.empty());
  EXPECT_EQ(core_to_use(-1), cores.back());
  EXPECT_EQ(core_to_use(7), 7);
  const ChildCommand command{
      {"sh", "-c", "grep Cpus_allowed_list /proc/self/status"}, {}, {cores.back()}, {}};
  EXPECT_EQ(output_of(command), "Cpus_allowed_list:\t" + std::to_string(cores.back()) + "\n");
}

}  // namespace
}  // namespace halfspace::compare
