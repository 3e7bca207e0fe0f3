#include "vision/frame/frame_fitter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>

#include "tests/vision/frame/exact_frame.h"
#include "tests/vision/stereo/stereo_scene.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;
using testing::ExactFrame;
using testing::ExactPair;
using testing::PaperRig;
using testing::WindowSeenFrom;

FrameFitSettings Settings() {
  return {.min_contrast_dn = 6.0,
          .reach_px = 4.0,
          .far_px = 8.0,
          .min_side_support = 0.4,
          .border = {.smallest_m = 0.02, .largest_share = 0.3, .min_contrast_dn = 6.0},
          .size = {},
          .planes = {},
          .vignetting = {.black_dn = 8.0, .power = 4.5}};
}

FrameRectangle RectangleOf(const ExactFrame& frame) {
  FrameRectangle rectangle;
  rectangle.R_LO = frame.X_LO.rotation();
  rectangle.p_LO = frame.X_LO.translation();
  rectangle.width_m = frame.width_m;
  rectangle.height_m = frame.height_m;
  rectangle.border_m = frame.border_m;
  return rectangle;
}

// Off by a pixel or two, as what corners of segments make of it.
FrameRectangle RoughlyAt(const ExactFrame& frame) {
  FrameRectangle::Step step = FrameRectangle::Step::Zero();
  step.head<8>() << 0.01, -0.01, 0.005, 0.003, -0.004, 0.03, 0.005, -0.006;
  FrameRectangle rough = RectangleOf(frame).Moved(step);
  rough.border_m = 0.0;
  return rough;
}

struct Pair {
  StereoCalibration rig = PaperRig();
  StereoObservation seen;

  std::vector<CameraView> Views() const {
    return {{rig.left, Pose(), seen.left}, {rig.right, rig.X_RL, seen.right}};
  }
};

Pair Photographed(const ExactFrame& frame, double noise_dn = 1.0) {
  Pair pair;
  pair.seen = ExactPair(pair.rig, frame, noise_dn, RandomStream(1));
  return pair;
}

std::variant<FrameFit, Miss> Fit(const Pair& pair, const ExactFrame& frame,
                                 const FrameFitSettings& settings = Settings()) {
  const auto views = pair.Views();
  FrameFitter fitter(views, settings);
  // The edges are those of the wall's opening, which is as large as the frame and before it.
  ExactFrame opening = frame;
  opening.X_LO = frame.X_LO * Pose(Eigen::Matrix3d::Identity(), {0.0, 0.0, frame.setback_m});
  const auto rough = fitter.FitRoughly(RoughlyAt(opening));
  if (!rough) return Miss{"rough", "too few points"};
  return fitter.Finish(*rough);
}

FrameFit Found(const std::variant<FrameFit, Miss>& result) {
  const Miss* miss = std::get_if<Miss>(&result);
  EXPECT_EQ(miss, nullptr) << miss->reason << ": " << miss->detail;
  return miss == nullptr ? std::get<FrameFit>(result) : FrameFit{};
}

ExactFrame PaintedFrame() {
  return {.X_LO = WindowSeenFrom({.distance_m = 3.0, .azimuth_deg = 20.0, .roll_deg = 4.0})};
}

TEST(FrameFitter, ARoughFitIsRightToATenthOfAPixel) {
  const ExactFrame frame = PaintedFrame();
  const Pair pair = Photographed(frame);
  const auto views = pair.Views();
  FrameFitter fitter(views, Settings());
  const auto rough = fitter.FitRoughly(RoughlyAt(frame));
  ASSERT_TRUE(rough.has_value());
  const FrameRectangle& found = rough->adjustment.frame;
  // z²/(f b) a pixel of disparity; across z/f.
  EXPECT_LT(std::abs((found.p_LO - frame.X_LO.translation()).z()), 0.1 * 9.0 / (667.0 * 0.35));
  EXPECT_LT((found.p_LO - frame.X_LO.translation()).head<2>().norm(), 0.1 * 3.0 / 667.0 + 0.001);
  EXPECT_EQ(rough->inner_support, 0.0);
  // Parts of a side that start beyond the reach of the search have no edge, until a second round.
  const auto again = fitter.FitRoughly(found);
  ASSERT_TRUE(again.has_value());
  EXPECT_GT(again->LeastSupport(), 0.8);
}

TEST(FrameFitter, APaintedFrameIsFittedInOnePlaneWithItsBorder) {
  const ExactFrame frame = PaintedFrame();
  const FrameFit fit = Found(Fit(Photographed(frame), frame));
  EXPECT_TRUE(fit.is_in_one_plane);
  EXPECT_TRUE(fit.is_flat);
  const Vector3d off = fit.front.p_LO - frame.X_LO.translation();
  const Vector3d sigma = fit.adjustment.covariance.diagonal().segment<3>(3).cwiseSqrt();
  for (int i = 0; i < 3; ++i) EXPECT_LT(std::abs(off[i]), 4.0 * sigma[i]) << i;
  EXPECT_LT(sigma.z(), 0.001);
  EXPECT_NEAR(fit.front.border_m, frame.border_m, 0.001);
  EXPECT_NEAR(fit.front.width_m, frame.width_m, 0.001);
  EXPECT_GT(fit.LeastSupport(), 0.8);
  EXPECT_GT(fit.LeastInnerSupport(), 0.8);
}

TEST(FrameFitter, BeforeADarkRoomTheOuterSidesAreEnough) {
  ExactFrame frame = PaintedFrame();
  frame.opening_dn = frame.frame_dn;
  const FrameFit fit = Found(Fit(Photographed(frame), frame));
  EXPECT_FALSE(fit.is_in_one_plane);
  EXPECT_EQ(fit.inner_support, 0.0);
  // How far the front is behind its edges nothing tells, so that this is in the covariance.
  const double sigma_m = std::sqrt(fit.adjustment.covariance.block<3, 3>(3, 3).trace());
  EXPECT_LT((fit.front.p_LO - frame.X_LO.translation()).norm(), 4.0 * sigma_m);
}

TEST(FrameFitter, AFrameThatStandsBackIsBehindTheEdgesOfItsWall) {
  ExactFrame frame{.X_LO = WindowSeenFrom({.distance_m = 3.0, .azimuth_deg = 30.0})};
  frame.setback_m = 0.10;
  frame.opening_dn = 40.0;
  const FrameFit fit = Found(Fit(Photographed(frame), frame));
  const double off_m = (fit.front.p_LO - frame.X_LO.translation()).norm();
  const double sigma_m = std::sqrt(fit.adjustment.covariance.block<3, 3>(3, 3).trace());
  EXPECT_LT(off_m, 4.0 * sigma_m);
  // At the wall's face it would be as far off as it is set back.
  EXPECT_LT(off_m, 0.5 * frame.setback_m) << sigma_m;
}

// A frame of 1 m is a longer base than that of the rig, 0.35 m; a size that is known to 0.01 mm
// leaves its distance of 3 m uncertain by 0.03 mm.
TEST(FrameFitter, AKnownSizeMakesTheDistanceMoreCertain) {
  const ExactFrame frame = PaintedFrame();
  const Pair pair = Photographed(frame, 4.0);
  FrameFitSettings knowing = Settings();
  knowing.size = SizePrior{frame.width_m, frame.height_m, 1e-5};
  const FrameFit unknown = Found(Fit(pair, frame));
  const FrameFit known = Found(Fit(pair, frame, knowing));
  EXPECT_LT(known.adjustment.covariance(5, 5), 0.8 * unknown.adjustment.covariance(5, 5));
}

TEST(FrameFitter, ASideWithoutAnEdgeIsAMiss) {
  const ExactFrame frame = PaintedFrame();
  Pair pair = Photographed(frame);
  const auto views = pair.Views();
  FrameFitter fitter(views, Settings());
  const auto rough = fitter.FitRoughly(RoughlyAt(frame));
  ASSERT_TRUE(rough.has_value());
  // A curtain over the frame's right side, in both images.
  for (const CameraView& view : views) {
    const auto upper = view.camera.Project(
        view.X_CL * RectangleOf(frame).PointOn(Side::kRight, Border::kOuter, 0.0));
    const int u = static_cast<int>(upper.value().x()) - 40;
    cv::Mat1b image = view.image;
    image.colRange(u, image.cols) = uchar{165};
  }
  const auto result = fitter.Finish(*rough);
  ASSERT_TRUE(std::holds_alternative<Miss>(result));
  const std::string& reason = std::get<Miss>(result).reason;
  EXPECT_TRUE(reason == "unsupported_side" || reason == "no_edges") << reason;
}

TEST(FrameFitter, WithoutEdgesThereIsNoRectangle) {
  const ExactFrame frame = PaintedFrame();
  Pair pair = Photographed(frame);
  pair.seen.left = uchar{100};
  pair.seen.right = uchar{100};
  const auto views = pair.Views();
  FrameFitter fitter(views, Settings());
  EXPECT_FALSE(fitter.FitRoughly(RoughlyAt(frame)));
}

}  // namespace
}  // namespace fenestra
