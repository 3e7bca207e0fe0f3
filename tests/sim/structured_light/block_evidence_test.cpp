#include "sim/structured_light/block_evidence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

TEST(ChanceMatchTest, ItsMedianIsThatOfTheGreatestOfSoManyNumbers) {
  // Φ(x)^N = 1/2 at ν = 0.
  for (const double places : {1.0, 10.0, 132.0}) {
    const double best = static_cast<double>(ChanceMatch{0.2, places}.Best(-1.0f, 0.0f));
    EXPECT_NEAR(std::pow(NormalShare(best / 0.2), places), 0.5, 1e-5) << places;
  }
}

TEST(ChanceMatchTest, ExceedsALevelAsOftenAsTheGreatestDoes) {
  const ChanceMatch chance{0.11, 50.0};
  const RandomStream stream(3);
  constexpr int kDraws = 20000;
  int above = 0;
  for (uint64_t i = 0; i < kDraws; ++i) {
    const float best = chance.Best(0.3f, static_cast<float>(stream.Normal(i)));
    if (best > 0.3f) ++above;
  }
  const double expected = 1.0 - std::pow(NormalShare(0.3 / 0.11), 50.0);
  // Five standard deviations of a binomial share: false alarm 6e-7.
  EXPECT_NEAR(above / static_cast<double>(kDraws), expected,
              5.0 * std::sqrt(expected * (1.0 - expected) / kDraws));
}

TEST(ChanceMatchTest, OnlyWhatIsEnoughIsDrawn) {
  const ChanceMatch chance{0.11, 130.0};
  for (float nu = -5.0f; nu < 5.0f; nu += 0.01f) {
    const float best = chance.Best(-1.0f, nu);
    for (const float enough : {0.2f, 0.4f, 0.6f}) {
      EXPECT_EQ(chance.Best(enough, nu), best > enough ? best : -1.0f) << nu << ", " << enough;
    }
  }
}

TEST(ChanceMatchTest, SumsOfNarrowAndWideGaussiansAreKnown) {
  EXPECT_DOUBLE_EQ(SumOfGaussian(1e-3), 1.0);
  // Wide ones approach their integral, π w.
  EXPECT_NEAR(SumOfGaussian(4.0), 3.14159265 * 4.0, 1e-3);
}

}  // namespace
}  // namespace fenestra
