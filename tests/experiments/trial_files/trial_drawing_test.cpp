#include "experiments/trial_files/trial_drawing.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "sim/structured_light/explained_depth.h"

namespace fenestra {
namespace {

PictureView View() {
  return {CameraModel::Pinhole(160, 120, 100.0), Pose()};
}

WindowEstimate WindowAt(const Eigen::Vector3d& p_CO) {
  WindowEstimate window;
  window.p_CO = p_CO;
  window.p_CV = {p_CO + Eigen::Vector3d(-0.5, -0.5, 0.0), p_CO + Eigen::Vector3d(0.5, -0.5, 0.0),
                 p_CO + Eigen::Vector3d(0.5, 0.5, 0.0), p_CO + Eigen::Vector3d(-0.5, 0.5, 0.0)};
  return window;
}

GroundTruth TruthAt(const Eigen::Vector3d& p_CO) {
  GroundTruth truth;
  truth.target.emplace();
  truth.target->p_CO = p_CO;
  truth.target->p_CV = WindowAt(p_CO).p_CV;
  return truth;
}

cv::Mat3b Grey() {
  return cv::Mat3b(120, 160, cv::Vec3b(90, 90, 90));
}

bool IsGreen(const cv::Vec3b& p) {
  return p[1] > p[0] + 30 && p[1] > p[2] + 30;
}
bool IsMagenta(const cv::Vec3b& p) {
  return p[0] > p[1] + 30 && p[2] > p[1] + 30;
}

TEST(TrialDrawing, TruthIsGreenAndAnEstimateMagentaWhereTheyAreSeen) {
  const PictureView view = View();
  const GroundTruth truth = TruthAt({0.0, 0.0, 2.0});
  const WindowEstimate estimate = WindowAt({0.2, 0.0, 2.0});
  const cv::Mat3b drawn = DrawTruthAndEstimate(Grey(), {&view, 1}, &truth, &estimate);
  // 100 px · 0.5/2 to either side of the middle, (79.5, 59.5); the estimate is 10 px to the right.
  EXPECT_TRUE(IsGreen(drawn(45, 54)) || IsGreen(drawn(45, 55)));
  EXPECT_TRUE(IsMagenta(drawn(45, 114)) || IsMagenta(drawn(45, 115)));
  EXPECT_EQ(drawn(5, 5), cv::Vec3b(90, 90, 90));
}

TEST(TrialDrawing, WhatIsNotThereIsNotDrawn) {
  const PictureView view = View();
  const auto differing = [](const cv::Mat3b& a) {
    return cv::countNonZero(cv::Mat(a != Grey()).reshape(1));
  };
  EXPECT_EQ(differing(DrawTruthAndEstimate(Grey(), {&view, 1}, nullptr, nullptr)), 0);
  const GroundTruth without_target;
  EXPECT_EQ(differing(DrawTruthAndEstimate(Grey(), {&view, 1}, &without_target, nullptr)), 0);
  // Behind the camera, and so far off its axis that pixels overflow.
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0, 0, -2), Eigen::Vector3d(0, 1e9, 1)}) {
    const WindowEstimate hidden = WindowAt(p);
    EXPECT_EQ(differing(DrawTruthAndEstimate(Grey(), {&view, 1}, nullptr, &hidden)), 0);
  }
}

TEST(TrialDrawing, ThePictureThatIsDrawnOnStaysAsItWas) {
  const PictureView view = View();
  const WindowEstimate estimate = WindowAt({0.0, 0.0, 2.0});
  const cv::Mat3b image = Grey();
  DrawTruthAndEstimate(image, {&view, 1}, nullptr, &estimate);
  EXPECT_EQ(cv::countNonZero(cv::Mat(image != Grey()).reshape(1)), 0);
  const cv::Mat1b grey(120, 160, uchar{90});
  EXPECT_EQ(DrawTruthAndEstimate(grey, {&view, 1}, nullptr, &estimate).channels(), 3);
}

TEST(TrialDrawing, DepthIsFalseColoursAndNoReturnIsBlack) {
  cv::Mat1w raw(1, 4);
  raw << 0, 500, 2000, 8000;
  const cv::Mat3b drawn = DrawDepth({.raw = raw, .unit_m = 0.001});
  EXPECT_EQ(drawn(0, 0), cv::Vec3b(0, 0, 0));
  EXPECT_GT(drawn(0, 1)[2], drawn(0, 1)[0]) << "near is red";
  EXPECT_GT(drawn(0, 3)[0], drawn(0, 3)[2]) << "far is blue";
  EXPECT_NE(drawn(0, 1), drawn(0, 2));
}

TEST(TrialDrawing, EachReasonForNoReturnHasAColour) {
  const std::vector<NoReturn> reasons = {
      NoReturn::kNone,    NoReturn::kNoSurface,    NoReturn::kRange,     NoReturn::kShadow,
      NoReturn::kGrazing, NoReturn::kDark,         NoReturn::kSaturated, NoReturn::kNoMatch,
      NoReturn::kBorder,  NoReturn::kNotRegistered};
  cv::Mat1b image(1, static_cast<int>(reasons.size()));
  for (size_t i = 0; i < reasons.size(); ++i) {
    image(static_cast<int>(i)) = static_cast<uchar>(reasons[i]);
  }
  std::set<std::tuple<int, int, int>> colors;
  for (const cv::Vec3b& color : DrawNoReturn(image)) colors.insert({color[0], color[1], color[2]});
  EXPECT_EQ(colors.size(), reasons.size());
  EXPECT_EQ(DrawNoReturn(image)(0, 0), cv::Vec3b(255, 255, 255));
}

TEST(TrialDrawing, ViewsAreThoseOfTheSensorsCameras) {
  const CameraModel small = CameraModel::Pinhole(160, 120, 100.0);
  const CameraModel large = CameraModel::Pinhole(320, 240, 200.0);
  const Pose X = Pose::Translation({-0.3, 0.0, 0.0});
  const auto stereo = ObservationViews(StereoCalibration{.left = small, .right = large, .X_RL = X});
  EXPECT_EQ(stereo[0].camera.width_px(), 160);
  EXPECT_EQ(stereo[0].X_PC, Pose());
  EXPECT_EQ(stereo[1].X_PC, X);
  // Estimates are in the depth camera's frame.
  const auto rgbd = ObservationViews(
      RgbdCalibration{.color = large, .depth = small, .X_KD = X, .depth_unit_m = 0.001});
  EXPECT_EQ(rgbd[0].camera.width_px(), 320);
  EXPECT_EQ(rgbd[0].X_PC, X);
  EXPECT_EQ(rgbd[1].X_PC, Pose());
}

}  // namespace
}  // namespace fenestra
