#include "vision/stereo/paper/block_matching.h"

#include <gtest/gtest.h>

#include "core/random/random_stream.h"
#include "tests/vision/stereo/stereo_scene.h"

namespace fenestra {
namespace {

constexpr BlockMatchingSettings kSettings{.window_px = 15,
                                          .nearest_disparity_px = 90,
                                          .farthest_disparity_px = 12,
                                          .uniqueness_percent = 10,
                                          .texture_threshold = 10,
                                          .speckle_area_px = 0,
                                          .speckle_step_px = 1.0,
                                          .left_right_check = false};

cv::Mat1b Texture(int width, int height) {
  cv::Mat1b image(height, width);
  const RandomStream stream(3);
  for (int i = 0; i < width * height; ++i) {
    image(i / width, i % width) =
        static_cast<uint8_t>(255.0 * stream.Uniform(static_cast<uint64_t>(i)));
  }
  return image;
}

TEST(BlockMatching, ShiftedTextureIsMatchedUpToEveryBorder) {
  constexpr int kShift = 60;
  const cv::Mat1b wide = Texture(300 + kShift, 80);
  const RectifiedPair pair{wide.colRange(0, 300).clone(), wide.colRange(kShift, 300 + kShift)};
  const cv::Mat1b seen(80, 300, 255);
  const cv::Mat1f disparity = MatchBlocks(pair, seen, seen, kSettings);
  int wrong = 0;
  for (int v = 0; v < disparity.rows; ++v) {
    for (int u = 0; u < disparity.cols; ++u) {
      // A parabola through sums around an exact match stays within half a pixel of it. Left of
      // the shift, the match would lie outside the right image.
      const float d = disparity(v, u);
      if (u < kShift - 1) {
        if (d != 0.0f && d > static_cast<float>(u) + 1.0f) ++wrong;
      } else if (u >= kShift && std::abs(d - kShift) > 0.5f) {
        ++wrong;
      }
    }
  }
  EXPECT_EQ(wrong, 0);
}

TEST(BlockMatching, WhatNoSensorSawIsNotMatched) {
  const cv::Mat1b wide = Texture(260, 60);
  const RectifiedPair pair{wide.colRange(0, 230).clone(), wide.colRange(30, 260).clone()};
  const cv::Mat1b seen(60, 230, 255);
  cv::Mat1b hidden = seen.clone();
  hidden.colRange(100, 150) = 0;
  const cv::Mat1f left_hidden = MatchBlocks(pair, hidden, seen, kSettings);
  EXPECT_EQ(cv::countNonZero(left_hidden.colRange(100, 150)), 0);
  EXPECT_GT(cv::countNonZero(left_hidden.colRange(150, 200)), 0);
  const cv::Mat1f right_hidden = MatchBlocks(pair, seen, hidden, kSettings);
  // Sub-pixel disparities round to 30 ± 1.
  EXPECT_EQ(cv::countNonZero(right_hidden.colRange(131, 179)), 0);
}

TEST(BlockMatching, ConstantImagesHaveNoDisparity) {
  for (const int grey : {0, 128, 255}) {
    const cv::Mat1b flat(64, 200, static_cast<uint8_t>(grey));
    const cv::Mat1b seen(64, 200, 255);
    EXPECT_EQ(cv::countNonZero(MatchBlocks({flat, flat}, seen, seen, kSettings)), 0);
  }
}

// Share of a side's pixels with a disparity within 1 px of the truth.
double MatchedShare(const cv::Mat1f& disparity, const cv::Rect& side, double truth_px) {
  const cv::Mat1b right = cv::abs(disparity(side) - truth_px) < 1.0;
  return cv::countNonZero(right) / static_cast<double>(side.area());
}

TEST(GuidedMatching, BringsBackTheRightSideOfAFarFrame) {
  const StereoCalibration rig = testing::PaperRig();
  const Pose X_LO = testing::WindowSeenFrom({.distance_m = 8.0});
  const StereoObservation seen_by_rig =
      testing::Photograph(rig, X_LO, {}, {.noise_dn = 2.0}, RandomStream(5));
  const StereoRectification rectification(rig, 1.0);
  const RectifiedPair pair = rectification.Rectify(seen_by_rig);
  BlockMatchingSettings settings = kSettings;
  settings.nearest_disparity_px = 195;
  settings.speckle_area_px = 200;
  const cv::Mat1f once =
      MatchBlocks(pair, rectification.left_seen(), rectification.right_seen(), settings);
  const auto patches = FindPatches(once, {.opening_px = 7,
                                          .gap_height_px = 25,
                                          .gap_width_px = 5,
                                          .min_height_px = 20,
                                          .disparity_step_px = 1.0});
  const auto twice =
      MatchAgainNearPatches(pair, rectification.left_seen(), rectification.right_seen(), settings,
                            once, patches, 0.3 / 0.35);
  ASSERT_TRUE(twice);
  // The right border's middle: 0.45 m right of the centroid, 0.6 m of its height.
  const double scale = rectification.camera().f_px / 8.0;
  const int u = static_cast<int>(375.5 + (0.175 + 0.45) * scale);
  const int half = static_cast<int>(0.3 * scale);
  const cv::Rect side(u - 7, 240 - half, 15, 2 * half);
  const double truth_px = rectification.camera().DisparityFromDepth(8.0);
  // The first search finds the side's two ends at most, since there the frame's corners differ.
  EXPECT_LT(MatchedShare(once, side, truth_px), 0.5);
  EXPECT_GT(MatchedShare(*twice, side, truth_px), 0.9);
}

}  // namespace
}  // namespace fenestra
