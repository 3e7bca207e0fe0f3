#include "scenes/facade/wall_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace fenestra {
namespace {

constexpr double kTexel_m = kPatternSide_m / kPatternSide_px;

WallPattern Pattern(WallFinish finish, uint64_t seed = 1) {
  return MakeWallPattern(finish, RandomStream(seed));
}

// Means along the columns, or along the rows.
std::vector<double> Profile(const cv::Mat1f& image, bool of_columns) {
  cv::Mat1d means;
  cv::reduce(image, means, of_columns ? 0 : 1, cv::REDUCE_AVG, CV_64F);
  return {means.begin(), means.end()};
}

// Where a profile has its joints: the middles of the runs beyond half of its extent.
std::vector<double> JointsIn(const std::vector<double>& profile, bool dark) {
  const auto [low, high] = std::minmax_element(profile.begin(), profile.end());
  const double threshold = 0.5 * (*low + *high);
  std::vector<double> joints;
  size_t begin = profile.size();
  for (size_t i = 0; i <= profile.size(); ++i) {
    const bool in_joint =
        i < profile.size() && (dark ? profile[i] < threshold : profile[i] > threshold);
    if (in_joint && begin == profile.size()) begin = i;
    if (!in_joint && begin < profile.size()) {
      joints.push_back(0.5 * static_cast<double>(begin + i) * kTexel_m);
      begin = profile.size();
    }
  }
  return joints;
}

class WallPatterns : public ::testing::TestWithParam<WallFinish> {};
INSTANTIATE_TEST_SUITE_P(OfAllKinds, WallPatterns,
                         ::testing::Values(WallFinish::kPlaster, WallFinish::kBrick,
                                           WallFinish::kConcrete, WallFinish::kCladding),
                         [](const auto& finish) {
                           return WallFinishNames()[static_cast<size_t>(finish.param)];
                         });

TEST_P(WallPatterns, AreFunctionsOfTheStream) {
  const cv::Mat1f once = Pattern(GetParam()).lightness;
  EXPECT_EQ(once.size(), cv::Size(kPatternSide_px, kPatternSide_px));
  EXPECT_EQ(cv::countNonZero(once != Pattern(GetParam()).lightness), 0);
  EXPECT_GT(cv::countNonZero(once != Pattern(GetParam(), 2).lightness), kPatternSide_px);
  EXPECT_TRUE(cv::checkRange(once));
}

// DIN 4172: twelve courses to the metre; head joints every 25 cm, in running bond.
TEST(WallPattern, BricksStandInTheirCourses) {
  const cv::Mat1f grey = Pattern(WallFinish::kBrick).grey;
  const std::vector<double> beds = JointsIn(Profile(grey, false), false);
  // The joint at the pattern's edge is cut in two: half of it above and half below.
  ASSERT_EQ(beds.size(), 25u);
  for (size_t i = 1; i + 2 < beds.size(); ++i) {
    EXPECT_NEAR(beds[i + 1] - beds[i], 1.0 / 12.0, 2.0 * kTexel_m) << i;
  }
  // Of two neighbouring courses: by half a brick.
  const auto heads = [&](int course) {
    const int first = cvRound((course + 0.3) / 12.0 / kTexel_m);
    return JointsIn(Profile(grey.rowRange(first, first + 16), true), false);
  };
  const std::vector<double> even = heads(4);
  const std::vector<double> odd = heads(5);
  ASSERT_GE(even.size(), 8u);
  ASSERT_EQ(odd.size(), 8u);
  EXPECT_NEAR(odd[1] - odd[0], 0.25, 3.0 * kTexel_m);
  EXPECT_NEAR(std::fmod(odd[0] - even[1] + 2.0, 0.25), 0.125, 3.0 * kTexel_m);
}

// 71 mm of each 83.3 mm and 240 mm of each 250 mm are brick: 82 %.
TEST(WallPattern, MortarTakesTheShareOfItsJoints) {
  const WallPattern brick = Pattern(WallFinish::kBrick);
  const double mortar = 1.0 - (0.071 * 12.0) * (0.240 / 0.250);
  EXPECT_NEAR(cv::mean(brick.grey)[0], mortar, 0.02);
  // It is lighter than the bricks are on average.
  const double light = cv::mean(brick.lightness, brick.grey > 0.99f)[0];
  const double dark = cv::mean(brick.lightness, brick.grey < 0.01f)[0];
  EXPECT_GT(light, dark + 0.5);
}

TEST(WallPattern, OnlyBrickHasPlacesOfAnotherHue) {
  for (const WallFinish finish :
       {WallFinish::kPlaster, WallFinish::kConcrete, WallFinish::kCladding}) {
    EXPECT_TRUE(Pattern(finish).grey.empty());
  }
}

// Within half a board on either side of each joint, nothing is darker than the joint: it is four
// units deep, and shades and grain differ by about one.
TEST(WallPattern, BoardsOfCladdingHaveDarkJointsEvery125Millimetres) {
  const std::vector<double> columns = Profile(Pattern(WallFinish::kCladding).lightness, true);
  constexpr int kBoard_px = kPatternSide_px / 16;
  for (int joint = kBoard_px; joint < kPatternSide_px; joint += kBoard_px) {
    const auto begin = columns.begin() + joint - kBoard_px / 2;
    const auto darkest = std::min_element(begin, begin + kBoard_px);
    const double at_m = (static_cast<double>(darkest - columns.begin()) + 0.5) * kTexel_m;
    // Half of the joint's 6 mm.
    EXPECT_NEAR(at_m, joint * kTexel_m, 0.003) << joint;
    const double beside = 0.5 * (columns[static_cast<size_t>(joint - kBoard_px / 4)] +
                                 columns[static_cast<size_t>(joint + kBoard_px / 4)]);
    EXPECT_LT(*darkest, beside - 2.0) << joint;
  }
}

// Grain runs along the boards: neighbours above differ less than neighbours beside.
TEST(WallPattern, GrainOfCladdingRunsUpwards) {
  const cv::Mat1f lightness = Pattern(WallFinish::kCladding).lightness;
  const int n = kPatternSide_px - 8;
  const cv::Mat1f here = lightness(cv::Rect(0, 0, n, n));
  const double along = cv::norm(here, lightness(cv::Rect(0, 8, n, n)));
  const double across = cv::norm(here, lightness(cv::Rect(8, 0, n, n)));
  EXPECT_LT(along, 0.7 * across);
}

TEST(WallPattern, ConcreteHasPanelsOfAMetreAndTieHoles) {
  const cv::Mat1f lightness = Pattern(WallFinish::kConcrete).lightness;
  const auto around = [&](double x_m, double y_m, int reach) {
    const cv::Point at(cvRound(x_m / kTexel_m), cvRound(y_m / kTexel_m));
    return cv::mean(lightness(cv::Rect(at.x - reach, at.y - reach, 2 * reach, 2 * reach)))[0];
  };
  // The joint in the middle, 8 mm wide, against what is 5 cm beside it.
  const std::vector<double> columns = Profile(lightness, true);
  EXPECT_LT(columns[kPatternSide_px / 2], columns[kPatternSide_px / 2 - 25] - 1.0);
  for (const double x_m : {0.25, 0.75, 1.25, 1.75}) {
    for (const double y_m : {0.5, 1.5}) EXPECT_LT(around(x_m, y_m, 3), around(x_m, y_m, 20) - 1.0);
  }
}

}  // namespace
}  // namespace fenestra
