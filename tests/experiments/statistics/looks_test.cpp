#include "experiments/statistics/intervals.h"

#include <gtest/gtest.h>

#include "core/random/random_stream.h"
#include "experiments/statistics/moments.h"

namespace fenestra {
namespace {

TEST(Looks, GrowByHalfUpToTheMost) {
  EXPECT_EQ(Looks(20, 100), (std::vector<int>{20, 30, 45, 67, 100}));
  EXPECT_EQ(Looks(1, 5), (std::vector<int>{1, 2, 3, 4, 5}));
  EXPECT_EQ(Looks(20, 20), std::vector<int>{20});
  EXPECT_EQ(Looks(20, 7), std::vector<int>{7});
  EXPECT_EQ(Looks(20, 30), (std::vector<int>{20, 30}));
  EXPECT_EQ(Looks(1'000'000, 2'000'000'000).back(), 2'000'000'000);
}

// Someone who stops as soon as the interval misses the true rate, the worst rule there is. Returns
// how many of the runs end with a wrong interval.
int WrongRuns(int runs, double rate, const std::vector<int>& looks, double confidence) {
  int wrong = 0;
  for (int run = 0; run < runs; ++run) {
    const RandomStream stream(static_cast<uint64_t>(run));
    int successes = 0;
    int trials = 0;
    for (const int look : looks) {
      for (; trials < look; ++trials) {
        successes += stream.Uniform(static_cast<uint64_t>(trials)) < rate ? 1 : 0;
      }
      const Interval interval = ClopperPearson(successes, trials, confidence);
      if (interval.lower <= rate && rate <= interval.upper) continue;
      ++wrong;
      break;
    }
  }
  return wrong;
}

TEST(Looks, TheWorstRuleToStopIsWrongNoMoreOftenThanItSays) {
  constexpr int kRuns = 2000;
  const std::vector<int> looks = Looks(20, 2000);
  const double corrected = LookConfidence(0.90, static_cast<int>(looks.size()));
  for (const double rate : {0.5, 0.9}) {
    // 10 % of 2000 are 200; the standard deviation of the count is 13.4; 4 above: 3e-5.
    EXPECT_LE(WrongRuns(kRuns, rate, looks, corrected), 254) << rate;
    // The twin: without the correction it is wrong far more often.
    EXPECT_GE(WrongRuns(kRuns, rate, looks, 0.90), 400) << rate;
  }
}

}  // namespace
}  // namespace fenestra
