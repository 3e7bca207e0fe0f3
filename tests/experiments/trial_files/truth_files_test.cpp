#include "experiments/trial_files/truth_files.h"

#include <gtest/gtest.h>

#include <limits>

namespace fenestra {
namespace {

constexpr double kDistance_m = 2.0;

/// A window of 1 m that a camera faces squarely, in a wall whose depth is the same everywhere.
class FrameVisibilityTest : public ::testing::Test {
 protected:
  FrameVisibilityTest() {
    images_.aovs.depth_m = cv::Mat1f(240, 320, static_cast<float>(kDistance_m));
  }

  double Share() const { return VisibleShare(images_, window_, 0.1); }

  WindowTruth window_{.p_CO = {0.0, 0.0, kDistance_m},
                      .p_CV = {{{-0.5, -0.5, kDistance_m},
                                {0.5, -0.5, kDistance_m},
                                {0.5, 0.5, kDistance_m},
                                {-0.5, 0.5, kDistance_m}}},
                      .normal_C = {0.0, 0.0, -1.0},
                      .width_m = 1.0,
                      .height_m = 1.0};
  TruthImages images_{.camera = CameraModel::Pinhole(320, 240, 300.0),
                      .X_WC = Pose(),
                      .aovs = {},
                      .band = Band::kLuminance,
                      .radiance = {},
                      .disparity_px = {}};
};

TEST_F(FrameVisibilityTest, NothingBeforeTheFrameIsAWholeViewWhateverIsBehind) {
  EXPECT_EQ(Share(), 1.0);
  images_.aovs.depth_m.setTo(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(Share(), 1.0);
}

TEST_F(FrameVisibilityTest, WhatStandsBeforeHalfOfItTakesHalf) {
  images_.aovs.depth_m.colRange(0, 160).setTo(1.0);
  // 256 points, symmetric about the covered half's border.
  EXPECT_EQ(Share(), 0.5);
  images_.aovs.depth_m.setTo(1.0);
  EXPECT_EQ(Share(), 0.0);
}

TEST_F(FrameVisibilityTest, WhatIsOutsideTheImageIsNotSeen) {
  // The border's middle is 135 px from the centre: upper and lower side are outside, and so is what
  // is farther than 120 px up or down of the others. Of these sides' points, at k/64 of 135 px for
  // odd k, those up to k = 55 are inside: 28 of 32.
  images_.camera = CameraModel::Pinhole(320, 240, 600.0);
  EXPECT_EQ(Share(), 0.5 * 28 / 32);
}

TEST_F(FrameVisibilityTest, FromBehindTheWallThereIsNoFrame) {
  window_.normal_C = -window_.normal_C;
  EXPECT_EQ(Share(), 0.0);
}

}  // namespace
}  // namespace fenestra
