#include "sim/structured_light/block_evidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

constexpr double kMean = 0.2;
constexpr double kSpread_px = 0.53;

BlockLight Even(cv::Size size, float dots, float ambient, float disparity) {
  return {cv::Mat1f(size, dots), cv::Mat1f(size, ambient), cv::Mat1f(size, disparity)};
}

BlockLight Random(cv::Size size) {
  BlockLight light = Even(size, 0.0f, 0.0f, 0.0f);
  const RandomStream stream(1);
  for (int i = 0; i < size.area(); ++i) {
    const auto index = static_cast<uint64_t>(3 * i);
    light.dots_dn(i) = static_cast<float>(100.0 * stream.Uniform(index));
    light.ambient_dn(i) = static_cast<float>(20.0 * stream.Uniform(index + 1));
    light.disparity_px(i) = static_cast<float>(30.0 + 2.0 * stream.Uniform(index + 2));
  }
  return light;
}

// How much a side of this length covers of the pixel that is so far from its centre.
double Covered(double side_px, int at) {
  return std::max(0.0, std::min(at + 0.5, 0.5 * side_px) - std::max(at - 0.5, -0.5 * side_px));
}

// A sum of n positive terms, each of which is a product of a few factors, is right to some n + 8
// roundings.
TEST(BlockEvidence, OfEvenLightIsThatOfAPixel) {
  constexpr double kRounding = (9 * 7 + 8) * 0.5 * std::numeric_limits<float>::epsilon();
  const BlockGatherer gatherer(9.0, 7.0, kMean, kSpread_px);
  const BlockEvidence block = gatherer.At(Even({40, 30}, 50.0f, 10.0f, 31.0f), {20, 15}, 31.0f);
  EXPECT_NEAR(block.dots, 50.0, 50.0 * kRounding);
  EXPECT_NEAR(block.dots2, 2500.0, 2500.0 * kRounding);
  EXPECT_NEAR(block.ambient, 10.0, 10.0 * kRounding);
  EXPECT_NEAR(block.smooth2, 400.0, 400.0 * kRounding);  // (0.2 · 50 + 10)²
  EXPECT_NEAR(block.evidence, 50.0, 50.0 * kRounding);
  EXPECT_NEAR(block.disparity, 50.0 * 31.0, 50.0 * 31.0 * kRounding);
  EXPECT_EQ(block.strongest, 50.0f);
  EXPECT_EQ(block.strongest_disparity, 31.0f);
}

// The sums written out. Single precision, and (1 - q/32)³² for exp(-q), which is q²/64 too small.
TEST(BlockEvidence, IsTheWeightedMeanOverTheBlock) {
  const double width_px = 6.3;
  const double height_px = 4.8;
  const BlockLight light = Random({40, 30});
  const BlockGatherer gatherer(width_px, height_px, kMean, kSpread_px);
  EXPECT_EQ(gatherer.reach_u(), 3);
  EXPECT_EQ(gatherer.reach_v(), 2);
  const cv::Point pixel(17, 11);
  const double d = 31.1;
  double dots = 0.0, dots2 = 0.0, ambient = 0.0, smooth2 = 0.0, evidence = 0.0;
  double disparity = 0.0;
  for (int y = -4; y <= 4; ++y) {
    for (int x = -4; x <= 4; ++x) {
      const double weight = Covered(width_px, x) * Covered(height_px, y) / (width_px * height_px);
      const cv::Point at = pixel + cv::Point(x, y);
      const double s = light.dots_dn(at);
      const double a = light.ambient_dn(at);
      const double q = std::pow(light.disparity_px(at) - d, 2) / (4.0 * kSpread_px * kSpread_px);
      const double e = s * std::pow(std::max(0.0, 1.0 - q / 32.0), 32);
      EXPECT_NEAR(e, s * std::exp(-q), 0.01 * s);
      dots += weight * s;
      dots2 += weight * s * s;
      ambient += weight * a;
      smooth2 += weight * std::pow(kMean * s + a, 2);
      evidence += weight * e;
      disparity += weight * e * light.disparity_px(at);
    }
  }
  const BlockEvidence block = gatherer.At(light, pixel, static_cast<float>(d));
  constexpr double kRounding = 1e-5;
  EXPECT_NEAR(block.dots, dots, kRounding * dots);
  EXPECT_NEAR(block.dots2, dots2, kRounding * dots2);
  EXPECT_NEAR(block.ambient, ambient, kRounding * ambient);
  EXPECT_NEAR(block.smooth2, smooth2, kRounding * smooth2);
  EXPECT_NEAR(block.evidence, evidence, kRounding * evidence);
  EXPECT_NEAR(block.disparity, disparity, kRounding * disparity);
}

TEST(BlockEvidence, ARowIsItsBlocksOneByOne) {
  const BlockLight light = Random({40, 30});
  const BlockGatherer gatherer(9.0, 7.0, kMean, kSpread_px);
  const std::vector<BlockEvidence> row = gatherer.Row(light, 12);
  ASSERT_EQ(row.size(), 40u - 8u);
  for (int i = 0; i < static_cast<int>(row.size()); ++i) {
    const cv::Point pixel(gatherer.reach_u() + i, 12);
    const BlockEvidence alone = gatherer.At(light, pixel, light.disparity_px(pixel));
    const BlockEvidence& among = row[static_cast<size_t>(i)];
    EXPECT_FLOAT_EQ(among.evidence, alone.evidence) << i;
    EXPECT_FLOAT_EQ(among.dots2, alone.dots2) << i;
    EXPECT_FLOAT_EQ(among.smooth2, alone.smooth2) << i;
    EXPECT_EQ(among.strongest, alone.strongest) << i;
    EXPECT_EQ(among.strongest_disparity, alone.strongest_disparity) << i;
  }
}

TEST(BlockEvidence, RowsOfBlocksThatLeaveTheImageHaveNone) {
  const BlockGatherer gatherer(9.0, 7.0, kMean, kSpread_px);
  const BlockLight light = Even({40, 30}, 50.0f, 10.0f, 31.0f);
  EXPECT_TRUE(gatherer.Row(light, 2).empty());
  EXPECT_FALSE(gatherer.Row(light, 3).empty());
  EXPECT_FALSE(gatherer.Row(light, 26).empty());
  EXPECT_TRUE(gatherer.Row(light, 27).empty());
  EXPECT_TRUE(gatherer.Row(Even({8, 30}, 50.0f, 10.0f, 31.0f), 15).empty());
}

// Where something nearer covers the columns from +2 on, six of nine show what is behind it, and the
// evidence for that is centred to the left.
TEST(BlockEvidence, IsCentredOnWhatIsAtItsDisparity) {
  BlockLight light = Even({40, 30}, 50.0f, 10.0f, 31.0f);
  light.disparity_px.colRange(22, 40) = 45.0f;
  const BlockGatherer gatherer(9.0, 7.0, kMean, kSpread_px);
  const BlockEvidence behind = gatherer.At(light, {20, 15}, 31.0f);
  EXPECT_NEAR(behind.evidence, 50.0f * 6.0f / 9.0f, 1e-3f);
  EXPECT_NEAR(behind.disparity / behind.evidence, 31.0f, 1e-3f);
  const BlockEvidence before = gatherer.At(light, {20, 15}, 45.0f);
  EXPECT_NEAR(before.evidence, 50.0f * 3.0f / 9.0f, 1e-3f);
}

TEST(BlockEvidence, NothingIsNoEvidence) {
  const BlockGatherer gatherer(9.0, 7.0, kMean, kSpread_px);
  const BlockLight nothing = Even({40, 30}, 0.0f, 10.0f, BlockLight::kNoDisparity);
  const BlockEvidence block = gatherer.At(nothing, {20, 15}, 31.0f);
  EXPECT_EQ(block.evidence, 0.0f);
  EXPECT_EQ(block.strongest, 0.0f);
  EXPECT_FLOAT_EQ(block.smooth2, 100.0f);
}

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
