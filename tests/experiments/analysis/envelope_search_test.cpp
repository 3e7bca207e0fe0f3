#include "experiments/analysis/envelope_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace fenestra {
namespace {

using ::testing::ElementsAre;

// Searches a curve of so many levels, where detector d holds from near[d] to far[d].
struct Searched {
  CurveVerdicts verdicts;
  int levels_run = 0;
};

Searched Search(size_t levels, const std::map<std::string, std::pair<size_t, size_t>>& holding) {
  Searched result;
  for (;;) {
    const std::vector<size_t> next = NextLevels(levels, result.verdicts);
    if (next.empty()) return result;
    for (const size_t level : next) {
      ++result.levels_run;
      for (const auto& [detector, range] : holding) {
        auto& at = result.verdicts[detector];
        at.resize(levels);
        const bool holds = range.first <= level && level <= range.second;
        EXPECT_FALSE(at[level].has_value()) << "run twice";
        at[level] = holds ? Verdict::kHolds : Verdict::kViolated;
      }
    }
  }
}

LevelCurve CurveOf(size_t levels) {
  LevelCurve curve;
  for (size_t i = 0; i < levels; ++i) curve.level.push_back(static_cast<double>(i));
  return curve;
}

TEST(EnvelopeSearch, StartsWithBothEndsAndQuarters) {
  EXPECT_THAT(NextLevels(33, {}), ElementsAre(0, 8, 16, 24, 32));
  EXPECT_THAT(NextLevels(3, {}), ElementsAre(0, 1, 2));
  EXPECT_THAT(NextLevels(10, {}), ElementsAre(0, 2, 4, 6, 8, 9));
}

TEST(EnvelopeSearch, FindsEveryFarBoundaryToOneLevel) {
  for (size_t levels : {3u, 10u, 33u, 50u}) {
    for (size_t far = 0; far < levels; ++far) {
      const Searched found = Search(levels, {{"a", {0, far}}});
      const auto ranges = HoldingRanges(CurveOf(levels), found.verdicts.at("a"));
      ASSERT_EQ(ranges.size(), 1u);
      EXPECT_EQ(ranges[0].to, static_cast<double>(far));
      if (far + 1 < levels) {
        EXPECT_EQ(ranges[0].fails_above, static_cast<double>(far + 1));
      }
      EXPECT_FALSE(ranges[0].fails_below.has_value());
      // The first ones, then halvings of a gap of at most levels/4: a part of the grid only.
      if (levels == 50) {
        EXPECT_LE(found.levels_run, 8 + 3);
      }
    }
  }
}

TEST(EnvelopeSearch, FindsBothBoundariesOfEachDetector) {
  const Searched found = Search(65, {{"a", {10, 40}}, {"b", {0, 63}}});
  const auto a = HoldingRanges(CurveOf(65), found.verdicts.at("a"));
  const auto b = HoldingRanges(CurveOf(65), found.verdicts.at("b"));
  ASSERT_EQ(a.size(), 1u);
  EXPECT_EQ(a[0].from, 10.0);
  EXPECT_EQ(a[0].fails_below, 9.0);
  EXPECT_EQ(a[0].to, 40.0);
  EXPECT_EQ(b[0].to, 63.0);
}

TEST(EnvelopeSearch, NowhereIsNoRange) {
  const Searched found = Search(33, {{"a", {100, 100}}});
  EXPECT_EQ(found.levels_run, 5);
  EXPECT_TRUE(HoldingRanges(CurveOf(33), found.verdicts.at("a")).empty());
}

}  // namespace
}  // namespace fenestra
