#include "experiments/statistics/paired.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

TEST(SignFlip, IsMcNemarsTestOfDiscordantPairs) {
  // 8 of 10 pairs speak for it: P(X ≥ 8) of a fair coin, (45 + 10 + 1)/1024.
  std::vector<double> d(10, 1.0);
  d[0] = d[1] = -1.0;
  d.resize(50, 0.0);
  EXPECT_DOUBLE_EQ(SignFlipPValue(d), 56.0 / 1024.0);
}

TEST(SignFlip, IsWilcoxonsTestOfRanks) {
  // Ranks 1 to 5, only the least one negative: 3 of the 32 assignments reach 13.
  EXPECT_DOUBLE_EQ(SignFlipPValue(std::vector<double>{-1.0, 2.0, 3.0, 4.0, 5.0}), 2.0 / 32.0);
  EXPECT_EQ(SignFlipPValue(std::vector<double>{}), 1.0);
  EXPECT_EQ(SignFlipPValue(std::vector<double>(9, 0.0)), 1.0);
}

TEST(SignFlip, KeepsItsLevel) {
  // Enumerated, resampled and normal: differences that are symmetric but far from normal.
  for (const int n : {10, 40}) {
    int rejected = 0;
    constexpr int kTests = 400;
    for (uint64_t t = 0; t < kTests; ++t) {
      std::vector<double> d;
      for (uint64_t i = 0; i < static_cast<uint64_t>(n); ++i) {
        const double x = RandomStream(9).Child("test", t).Normal(i);
        d.push_back(x * x * x);
      }
      rejected += SignFlipPValue(d) <= 0.05 ? 1 : 0;
    }
    EXPECT_LE(rejected, 400 * 0.05 + 4.0 * std::sqrt(400 * 0.05 * 0.95)) << n;
  }
  std::vector<double> many(3000, 1.0);
  for (size_t i = 0; i < 1450; ++i) many[i] = -1.0;
  // Σ d / √Σ d² = 100/√3000 = 1.826: an upper tail of 0.0339.
  EXPECT_NEAR(SignFlipPValue(many), 0.0339, 1e-4);
}

}  // namespace
}  // namespace fenestra
