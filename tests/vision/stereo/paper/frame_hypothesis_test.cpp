#include "vision/stereo/paper/frame_hypothesis.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace fenestra {
namespace {

constexpr RectifiedCamera kCamera{
    .f_px = 600.0, .cx_px = 200.0, .cy_px = 150.0, .baseline_m = 0.35};
constexpr float kWall_px = 70.0f;  // 3 m: 200 px are 1 m.

constexpr FrameCriteria kCriteria{.window_px = 15,
                                  .plane_tolerance_px = 0.75,
                                  .min_inlier_share = 0.6,
                                  .min_row_overlap = 0.7,
                                  .min_side_support = 0.5,
                                  .max_opening_rows = 0.5,
                                  .nearest_m = 1.2,
                                  .farthest_m = 15.0,
                                  .min_side_m = 0.3,
                                  .max_side_m = 3.0,
                                  .max_side_ratio = 2.0,
                                  .max_skew_rad = 0.26,
                                  .max_taper = 0.25};

const cv::Rect kLeftBand(100, 50, 20, 200);
const cv::Rect kRightBand(280, 50, 20, 200);

cv::Mat1f Wall(const std::vector<cv::Rect>& matched, float disparity_px = kWall_px) {
  cv::Mat1f disparity(300, 400, 0.0f);
  for (const cv::Rect& region : matched) disparity(region) = disparity_px;
  return disparity;
}

std::variant<FrameHypothesis, Miss> Find(const cv::Mat1f& disparity) {
  const auto patches = FindPatches(disparity, {.opening_px = 7,
                                               .gap_height_px = 25,
                                               .gap_width_px = 5,
                                               .min_height_px = 20,
                                               .disparity_step_px = 1.0});
  const auto found = FindFrames(patches, disparity, kCamera, kCriteria, 3);
  if (const Miss* miss = std::get_if<Miss>(&found)) return *miss;
  FrameHypothesis best = std::get<std::vector<FrameHypothesis>>(found).front();
  best.patches.clear();  // They end here.
  return best;
}

std::string Reason(const cv::Mat1f& disparity) {
  const auto found = Find(disparity);
  return std::holds_alternative<Miss>(found) ? std::get<Miss>(found).reason : "found";
}

TEST(FrameHypothesis, TwoBandsInOnePlaneAreClosedByTheirHull) {
  const auto found = Find(Wall({kLeftBand, kRightBand}));
  ASSERT_TRUE(std::holds_alternative<FrameHypothesis>(found)) << std::get<Miss>(found).detail;
  const FrameHypothesis& frame = std::get<FrameHypothesis>(found);
  EXPECT_EQ(cv::boundingRect(frame.hull), kLeftBand | kRightBand);
  EXPECT_NEAR(frame.plane.At({200.0, 150.0}), kWall_px, 1e-6);
}

TEST(FrameHypothesis, TheOuterEdgesOfAFrameWinOverTheInnerOnes) {
  const cv::Rect inner_left(140, 80, 16, 140);
  const cv::Rect inner_right(244, 80, 16, 140);
  const auto found = Find(Wall({kLeftBand, kRightBand, inner_left, inner_right}));
  ASSERT_TRUE(std::holds_alternative<FrameHypothesis>(found)) << std::get<Miss>(found).detail;
  EXPECT_EQ(cv::boundingRect(std::get<FrameHypothesis>(found).hull), kLeftBand | kRightBand);
}

TEST(FrameHypothesis, BandsAtOtherDepthsAreNoFrame) {
  // One band cannot tell a slope from a step, so the plane through both exists, but it is so
  // steep that nothing in it is a rectangle.
  cv::Mat1f disparity = Wall({kLeftBand, kRightBand});
  disparity(kRightBand) = 40.0f;
  EXPECT_EQ(Reason(disparity), "implausible_shape");
}

TEST(FrameHypothesis, BandsOfOtherRowsAreNoPair) {
  EXPECT_NE(Reason(Wall({cv::Rect(100, 10, 20, 130), cv::Rect(280, 160, 20, 130)})), "found");
}

TEST(FrameHypothesis, AFilledOpeningIsNoWindow) {
  EXPECT_EQ(Reason(Wall({cv::Rect(100, 50, 200, 200)})), "implausible_shape");
  // The outer sides of two windows, with the pier between them: not one window, though depth alone
  // cannot tell a window from a pier beside it.
  const auto found = Find(Wall({kLeftBand, kRightBand, cv::Rect(185, 50, 30, 200)}));
  if (const auto* frame = std::get_if<FrameHypothesis>(&found)) {
    EXPECT_NE(cv::boundingRect(frame->hull), kLeftBand | kRightBand);
  }
}

TEST(FrameHypothesis, ARoomBehindTheOpeningIsAWindowAllTheSame) {
  cv::Mat1f disparity = Wall({kLeftBand, kRightBand});
  disparity(cv::Rect(150, 80, 100, 140)) = 30.0f;
  EXPECT_EQ(Reason(disparity), "found");
}

TEST(FrameHypothesis, AFrameWithoutSidesIsNone) {
  // Two horizontal strips joined by a thin middle: the hull is a plausible square, its sides are
  // not matched.
  EXPECT_EQ(Reason(Wall({cv::Rect(100, 50, 200, 20), cv::Rect(100, 230, 200, 20),
                         cv::Rect(128, 50, 12, 200)})),
            "implausible_shape");
}

}  // namespace
}  // namespace fenestra
