// HALFSPACE_ACCURACY's text.
#include <gtest/gtest.h>

#include "state/derive/accuracy.h"

namespace halfspace::state {
namespace {

using raster::Accuracy;
using raster::Level;

TEST(ParseAccuracy, OneLevelIsForAllAxes) {
  EXPECT_EQ(parse_accuracy("draft"), Accuracy::all(Level::draft));
  EXPECT_EQ(parse_accuracy("standard"), Accuracy());
  EXPECT_EQ(parse_accuracy("exact"), Accuracy::all(Level::exact));
}

TEST(ParseAccuracy, EveryAxisAlone) {
  for (const raster::AccuracyAxis& axis : raster::kAccuracyAxes) {
    for (const Level level : {Level::draft, Level::standard, Level::exact}) {
      const std::string text = std::string(axis.name) + '=' + raster::kLevelNames[int(level)];
      Accuracy expected;
      expected.*axis.level = level;
      EXPECT_EQ(parse_accuracy(text), expected) << text;
      EXPECT_EQ(parse_accuracy("standard," + text), expected) << text;
      expected = Accuracy::all(Level::exact);
      expected.*axis.level = level;
      EXPECT_EQ(parse_accuracy("exact," + text), expected) << text;
    }
  }
}

TEST(ParseAccuracy, SeveralAxesTheLastOfOneCounts) {
  Accuracy expected;
  expected.filter = Level::exact;
  expected.lod = Level::draft;
  EXPECT_EQ(parse_accuracy("filter=draft,lod=draft,filter=exact"), expected);
  expected = Accuracy::all(Level::draft);
  expected.fog = expected.coverage = Level::standard;
  EXPECT_EQ(parse_accuracy("draft,coverage=standard,fog=standard"), expected);
}

TEST(ParseAccuracy, RefusesWhatItDoesNotKnow) {
  for (const char* text : {"", "best", "Exact", "exact ", " exact", ",exact", "exact,", "filter",
                           "filter=", "filter=2", "=exact", "filter==exact", "filters=exact", "exact,draft",
                           "filter=draft,exact", "exact,filter=draft,", "exact;filter=draft", "all=exact"}) {
    EXPECT_EQ(parse_accuracy(text), std::nullopt) << '"' << text << '"';
  }
}

}  // namespace
}  // namespace halfspace::state
