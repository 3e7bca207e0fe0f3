#include "vision/frame/adjustment/frame_adjustment.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Points = std::vector<std::vector<EdgePoint>>;
using Covariance = Eigen::Matrix<double, FrameRectangle::kParameters, FrameRectangle::kParameters>;

constexpr int kPlaces = 20;  // Along each side.

std::vector<CameraView> Views() {
  const CameraModel camera = CameraModel::Pinhole(752, 480, 667.0);
  return {{camera, Pose(), {}}, {camera, Pose::Translation({-0.35, 0.0, 0.0}), {}}};
}

FrameRectangle Frame() {
  FrameRectangle frame;
  frame.R_LO = RotationFromVector({0.0, 0.4, 0.1}) * RotationFromVector({M_PI, 0.0, 0.0});
  frame.p_LO = {0.2, -0.1, 3.0};
  frame.width_m = 1.1;
  frame.height_m = 0.9;
  frame.border_m = 0.1;
  return frame;
}

// Where the views see the frame's sides, off along their normals by noise.
Points PointsOf(const std::vector<CameraView>& views, const FrameRectangle& frame,
                const std::vector<Border>& borders, double noise_px, const RandomStream& stream,
                double sigma_px = 0.05) {
  Points points;
  uint64_t next = 0;
  for (const CameraView& view : views) {
    points.emplace_back();
    const Vector2d centre = view.camera.Project(view.X_CL * frame.p_LO).value();
    for (const Border border : borders) {
      for (const Side side : kAllSides) {
        const auto project = [&](double share) {
          return view.camera.Project(view.X_CL * frame.PointOn(side, border, share)).value();
        };
        for (int i = 0; i < kPlaces; ++i) {
          const double share = (i + 0.5) / kPlaces;
          const Vector2d along = (project(share + 0.01) - project(share - 0.01)).normalized();
          Vector2d normal(along.y(), -along.x());
          const Vector2d pixel = project(share);
          if (normal.dot(pixel - centre) < 0.0) normal = -normal;
          points.back().push_back({.side = side,
                                   .border = border,
                                   .share = share,
                                   .normal = normal,
                                   .pixel = pixel + noise_px * stream.Normal(next++) * normal,
                                   .sigma_px = sigma_px});
        }
      }
    }
  }
  return points;
}

// Of the first eight or nine parameters: those of a frame in one plane.
FrameRectangle::Step ErrorOf(const FrameRectangle& estimate, const FrameRectangle& truth) {
  FrameRectangle::Step error = FrameRectangle::Step::Zero();
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(estimate.R_LO.transpose() * truth.R_LO));
  error.head<3>() = turn.angle() * turn.axis();
  error.segment<3>(3) = truth.p_LO - estimate.p_LO;
  error[6] = truth.width_m - estimate.width_m;
  error[7] = truth.height_m - estimate.height_m;
  error[8] = truth.border_m - estimate.border_m;
  return error;
}

FrameRectangle Displaced(const FrameRectangle& frame) {
  FrameRectangle::Step step = FrameRectangle::Step::Zero();
  step.head<9>() << 0.02, -0.03, 0.01, 0.01, -0.02, 0.1, 0.03, -0.02, 0.01;
  return frame.Moved(step);
}

TEST(FrameAdjustment, ExactEdgesGiveTheFrameBack) {
  const auto views = Views();
  const auto points =
      PointsOf(views, Frame(), {Border::kOuter, Border::kInner}, 0.0, RandomStream(1));
  const auto adjusted = AdjustFrame(views, points, Displaced(Frame()), {});
  ASSERT_TRUE(adjusted.has_value());
  // A last step is shorter than 3e-4 standard deviations, of which the next ones are far less.
  EXPECT_LT(ErrorOf(adjusted->frame, Frame()).norm(), 1e-6);
  EXPECT_LT(adjusted->scale, 1e-3);
  for (const auto& view : adjusted->is_inlier) {
    for (const bool is_inlier : view) EXPECT_TRUE(is_inlier);
  }
}

TEST(FrameAdjustment, WhatWasNotSeenIsNotFitted) {
  const auto views = Views();
  const auto points = PointsOf(views, Frame(), {Border::kOuter}, 0.0, RandomStream(1));
  const FrameRectangle start = Displaced(Frame());
  const auto adjusted = AdjustFrame(views, points, start, {});
  ASSERT_TRUE(adjusted.has_value());
  EXPECT_EQ(adjusted->frame.border_m, start.border_m);
  EXPECT_EQ(adjusted->covariance.bottomRows<6>().norm(), 0.0);
  EXPECT_EQ(adjusted->frame.inner_relief_m, 0.0);
}

TEST(FrameAdjustment, CovarianceIsHonest) {
  // The sum of the normalised squared errors of 200 fits of 9 parameters follows χ² with 1800
  // degrees of freedom; two-sided, with a false-alarm rate of 1 %. Where the residuals are by
  // chance larger than their σ the covariance grows with them, by 4 % at most of 320 points.
  const auto views = Views();
  constexpr int kFits = 200;
  double sum = 0.0;
  for (uint64_t i = 0; i < kFits; ++i) {
    const auto points = PointsOf(views, Frame(), {Border::kOuter, Border::kInner}, 0.05,
                                 RandomStream(5).Child("fit", i));
    const auto adjusted = AdjustFrame(views, points, Frame(), {});
    ASSERT_TRUE(adjusted.has_value());
    const Eigen::Matrix<double, 9, 1> error = ErrorOf(adjusted->frame, Frame()).head<9>();
    sum += error.dot(adjusted->covariance.topLeftCorner<9, 9>().inverse() * error);
  }
  const boost::math::chi_squared law(9.0 * kFits);
  EXPECT_GT(sum, 0.96 * quantile(law, 0.005));
  EXPECT_LT(sum, quantile(law, 0.995));
  // The twins: covariances halved, and doubled.
  EXPECT_GT(2.0 * sum, quantile(law, 0.995));
  EXPECT_LT(0.5 * sum, 0.96 * quantile(law, 0.005));
}

TEST(FrameAdjustment, LargerResidualsWidenTheCovariance) {
  const auto views = Views();
  const RandomStream stream(7);
  const auto as_said = PointsOf(views, Frame(), {Border::kOuter}, 0.05, stream);
  const auto threefold = PointsOf(views, Frame(), {Border::kOuter}, 0.15, stream);
  const auto one = AdjustFrame(views, as_said, Frame(), {});
  const auto three = AdjustFrame(views, threefold, Frame(), {});
  ASSERT_TRUE(one.has_value() && three.has_value());
  // Of 160 points the scale is known to 6 %.
  EXPECT_NEAR(three->scale, 3.0, 0.5);
  EXPECT_NEAR(three->covariance(5, 5) / one->covariance(5, 5),
              std::pow(three->scale / std::max(1.0, one->scale), 2), 0.2);
}

TEST(FrameAdjustment, AForeignEdgeAtAQuarterOfASideIsLeftOut) {
  const auto views = Views();
  auto points = PointsOf(views, Frame(), {Border::kOuter}, 0.05, RandomStream(3));
  for (auto& view : points) {
    for (int i = 0; i < kPlaces / 4; ++i) {
      view[static_cast<size_t>(i)].pixel += 1.5 * view[static_cast<size_t>(i)].normal;
    }
  }
  const auto adjusted = AdjustFrame(views, points, Displaced(Frame()), {});
  ASSERT_TRUE(adjusted.has_value());
  for (const auto& view : adjusted->is_inlier) {
    for (size_t i = 0; i < kPlaces / 4; ++i) EXPECT_FALSE(view[i]) << i;
  }
  const double sigma_m = std::sqrt(adjusted->covariance(5, 5));
  EXPECT_LT(std::abs(ErrorOf(adjusted->frame, Frame())[5]), 4.0 * sigma_m);
}

TEST(FrameAdjustment, ErrorsThatASideHasInCommonAreNotAveraged) {
  const auto views = Views();
  auto points = PointsOf(views, Frame(), {Border::kOuter}, 0.0, RandomStream(1), 0.001);
  const auto apart = AdjustFrame(views, points, Frame(), {});
  for (auto& view : points) {
    for (EdgePoint& point : view) point.common_sigma_px = 0.1;
  }
  const auto together = AdjustFrame(views, points, Frame(), {});
  ASSERT_TRUE(apart.has_value() && together.has_value());
  // Eight sides' offsets, of 0.1 px each, against 160 places of 0.001 px.
  const double ratio = together->covariance(6, 6) / apart->covariance(6, 6);
  EXPECT_GT(ratio, 0.5 * kPlaces * std::pow(0.1 / 0.001, 2));
}

// Depth of a frame whose sides are all about as far from the image's centre as the frame is: by a
// disparity that is off by as much as both pictures are displaced, each on its own, Z² √2 σ/(f B).
TEST(FrameAdjustment, DisplacedPicturesOfADistantFrameMoveItAsAWhole) {
  const auto views = Views();
  FrameRectangle frame;
  frame.R_LO = RotationFromVector({M_PI, 0.0, 0.0});
  frame.p_LO = {0.175, 0.0, 30.0};
  frame.width_m = frame.height_m = 1.0;
  auto points = PointsOf(views, frame, {Border::kOuter}, 0.0, RandomStream(1), 1e-4);
  constexpr double kShift_px = 0.003;
  for (auto& view : points) {
    for (EdgePoint& point : view) point.shift_sigma_px = kShift_px;
  }
  const auto adjusted = AdjustFrame(views, points, frame, {});
  ASSERT_TRUE(adjusted.has_value());
  const double expected_m = 30.0 * 30.0 * std::sqrt(2.0) * kShift_px / (667.0 * 0.35);
  // Sides are 22 px = 0.05 half diagonals apart, so that displacements are correlated by 0.98.
  EXPECT_NEAR(std::sqrt(adjusted->covariance(5, 5)), expected_m, 0.02 * expected_m);
  // The twin: sides that err each on its own, two of them in each view.
  for (auto& view : points) {
    for (EdgePoint& point : view) std::swap(point.shift_sigma_px, point.common_sigma_px);
  }
  const auto apart = AdjustFrame(views, points, frame, {});
  ASSERT_TRUE(apart.has_value());
  EXPECT_NEAR(std::sqrt(apart->covariance(5, 5)), expected_m / std::sqrt(2.0), 0.02 * expected_m);
}

// One view tells the frame's shape, and its size how far it is: σ_z/z = σ/√(w² + h²), as width and
// height are known apart and the edges tell their ratio.
TEST(FrameAdjustment, InOneViewTheSizeTellsTheDistance) {
  std::vector<CameraView> views = Views();
  views.pop_back();
  const FrameRectangle frame = Frame();
  const auto points = PointsOf(views, frame, {Border::kOuter}, 0.0, RandomStream(1), 0.001);
  const double sigma_m = 0.01;
  const auto adjusted = AdjustFrame(views, points, Displaced(frame),
                                    {.size = SizePrior{frame.width_m, frame.height_m, sigma_m},
                                     .outer_relief = {},
                                     .inner_relief = {}});
  ASSERT_TRUE(adjusted.has_value());
  EXPECT_LT(ErrorOf(adjusted->frame, frame).head<8>().norm(), 1e-4);
  const double relative = std::sqrt(adjusted->covariance(5, 5)) / frame.p_LO.z();
  EXPECT_NEAR(relative, sigma_m / std::hypot(frame.width_m, frame.height_m), 0.02 * relative);
}

TEST(FrameAdjustment, AMeasuredPlaneHoldsTheFrame) {
  std::vector<CameraView> views = Views();
  views.pop_back();
  const FrameRectangle frame = Frame();
  const auto points = PointsOf(views, frame, {Border::kOuter}, 0.0, RandomStream(1), 0.001);
  const double relief_m = 0.08;
  const Vector3d normal = frame.R_LO.col(2);
  FramePrior prior;
  prior.planes.push_back({.m = normal / (normal.dot(frame.p_LO) + relief_m),
                          .information = 1e8 * Eigen::Matrix3d::Identity(),
                          .relief_m = relief_m});
  const auto adjusted = AdjustFrame(views, points, Displaced(frame), prior);
  ASSERT_TRUE(adjusted.has_value());
  EXPECT_LT(ErrorOf(adjusted->frame, frame).head<8>().norm(), 1e-4);
}

TEST(FrameAdjustment, AReliefThatIsExpectedIsFound) {
  const auto views = Views();
  FrameRectangle frame = Frame();
  frame.inner_relief_m = -0.06;
  const auto points =
      PointsOf(views, frame, {Border::kOuter, Border::kInner}, 0.0, RandomStream(1));
  FrameRectangle start = Displaced(frame);
  start.inner_relief_m = 0.0;
  const auto adjusted = AdjustFrame(
      views, points, start,
      {.size = {}, .outer_relief = {}, .inner_relief = ReliefPrior{.mean_m = 0.0, .sigma_m = 0.1}});
  ASSERT_TRUE(adjusted.has_value());
  EXPECT_NEAR(adjusted->frame.inner_relief_m, -0.06, 3.0 * std::sqrt(adjusted->covariance(13, 13)));
  EXPECT_LT(adjusted->frame.inner_relief_m, -0.05);
}

TEST(FrameAdjustment, TooFewPointsOrAFrameBehindTheCamerasGiveNothing) {
  const auto views = Views();
  auto points = PointsOf(views, Frame(), {Border::kOuter}, 0.0, RandomStream(1));
  Points few = points;
  for (auto& view : few) view.resize(9);
  EXPECT_FALSE(AdjustFrame(views, few, Frame(), {}));
  FrameRectangle behind = Frame();
  behind.p_LO.z() = -3.0;
  EXPECT_FALSE(AdjustFrame(views, points, behind, {}));
}

}  // namespace
}  // namespace fenestra
