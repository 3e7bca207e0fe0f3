#include "experiments/validation/plane_figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random/random_stream.h"

namespace fenestra::validation {
namespace {

constexpr double kStep = 2.92e-3;
const Eigen::Vector3d kWall(0.05, -0.03, 0.4);

// A wall whose 1/z is off by a field [1/m], with the whole image as its mask.
DepthView Wall(const cv::Mat1d& off) {
  DepthView view{cv::Mat1d(off.size()), 525.0, {319.5, 239.5}};
  for (int v = 0; v < off.rows; ++v) {
    for (int u = 0; u < off.cols; ++u) {
      view.z_m(v, u) = 1.0 / (kWall.dot(view.RayOf(u, v)) + off(v, u));
    }
  }
  return view;
}

cv::Mat1d WhiteNoise(double sigma) {
  cv::Mat1d noise(480, 640);
  const RandomStream stream(7);
  uint64_t i = 0;
  for (double& value : noise) value = sigma * stream.Normal(i++);
  return noise;
}

cv::Mat1b All(const cv::Mat1d& like) {
  return cv::Mat1b(like.size(), 255);
}

TEST(PlaneFiguresTest, AFlatWallIsFittedExactlyAndHasNoNoise) {
  const cv::Mat1d flat = cv::Mat1d::zeros(480, 640);
  const DepthView view = Wall(flat);
  EXPECT_LT((FitPlane(view, All(flat)) - kWall).norm(), 1e-12);
  const PlaneFigures figures = Measure(view, All(flat), kWall, kStep);
  EXPECT_EQ(figures.blocks, 15 * 20);
  EXPECT_LT(figures.noise_steps.value, 1e-9);
}

// 300 blocks of 1024 pixels, of which a plane of three parameters takes little: the median's
// standard error is 1.25 σ √(1/2048)/√300 = 0.0016 σ, six of them are a hundredth.
TEST(PlaneFiguresTest, WhiteNoiseHasItsSizeAndNoCorrelation) {
  const cv::Mat1d noise = WhiteNoise(0.5 * kStep);
  const PlaneFigures figures = Measure(Wall(noise), All(noise), kWall, kStep);
  EXPECT_NEAR(figures.noise_steps.value, 0.5, 0.005);
  EXPECT_NEAR(figures.noise_steps.error, 0.0016 * 0.5, 0.0004);
  for (const Estimated& lag : figures.along_rows) {
    EXPECT_NEAR(lag.value, 0.0, 6.0 * lag.error + 3.0 / 1024.0);  // A plane takes 3 of 1024.
  }
}

// Means of two neighbours correlate by 1/2 at one pixel along rows, and not along columns.
TEST(PlaneFiguresTest, MeansOfTwoNeighboursCorrelateByOneHalf) {
  const cv::Mat1d noise = WhiteNoise(0.5 * kStep);
  cv::Mat1d means = noise.clone();
  means.colRange(1, means.cols) = 0.5 * (noise.colRange(0, 639) + noise.colRange(1, 640));
  const PlaneFigures figures = Measure(Wall(means), All(means), kWall, kStep);
  EXPECT_NEAR(figures.along_rows[0].value, 0.5, 0.01);
  EXPECT_NEAR(figures.along_rows[1].value, 0.0, 0.02);
  EXPECT_NEAR(figures.along_columns[0].value, 0.0, 0.02);
}

TEST(PlaneFiguresTest, BinsCountTheirReturns) {
  const cv::Mat1d flat = cv::Mat1d::zeros(480, 640);
  DepthView view = Wall(flat);
  view.z_m.colRange(0, 320) = 0.0;
  int pixels = 0;
  int valid = 0;
  for (const auto& [place, bin] : Measure(view, All(flat), kWall, kStep).bins) {
    pixels += bin.pixels;
    valid += bin.valid;
  }
  EXPECT_EQ(pixels, 640 * 480);
  EXPECT_EQ(valid, 320 * 480);
}

// A wave of 200 px is a plane's error, not a block's noise: √(1/2) of its amplitude.
TEST(PlaneFiguresTest, AWaveIsASmoothErrorAndNoiseIsNone) {
  cv::Mat1d wave(480, 640);
  for (int v = 0; v < wave.rows; ++v) {
    for (int u = 0; u < wave.cols; ++u)
      wave(v, u) = kStep * std::sin(2.0 * std::numbers::pi * u / 200.0);
  }
  EXPECT_NEAR(SmoothError(Wall(wave), All(wave), kStep), std::sqrt(0.5), 0.1);
  const cv::Mat1d noise = WhiteNoise(0.5 * kStep);
  EXPECT_LT(SmoothError(Wall(noise), All(noise), kStep), 0.1);
}

// Levels of 1/z that are a step apart, each tenth of which no pixel has.
TEST(PlaneFiguresTest, TheStepIsFoundWhereLevelsAreMissing) {
  DepthView view{cv::Mat1d::zeros(1, 200), 525.0, {0.0, 0.0}};
  for (int i = 0; i < 200; ++i) {
    if (i % 10 != 0) view.z_m(0, i) = 1.0 / (0.2 + kStep * i);
  }
  EXPECT_NEAR(StepOfDepths(view), kStep, 1e-9);
}

// Something at 1 m from column 100 to 149 before a wall at 3 m; 20 px of hole on its left, 10 on
// its right, of which the second row lacks two.
TEST(OutlineHolesTest, HolesAreCountedAtTheOutlines) {
  DepthView view{cv::Mat1d(2, 300, 3.0), 525.0, {149.5, 0.5}};
  view.z_m.colRange(80, 100) = 0.0;
  view.z_m.colRange(100, 150) = 1.0;
  view.z_m.colRange(150, 160) = 0.0;
  view.z_m(0, 120) = 0.0;  // No outline.
  view.z_m(1, 80) = view.z_m(1, 81) = 3.0;
  const OutlineHoles holes = MeasureOutlines(view, {0, 2}, 1.5);
  EXPECT_EQ(holes.rows, 2);
  EXPECT_EQ(holes.left_px.value, 19.0);
  EXPECT_EQ(holes.both_px.value, 29.0);
  EXPECT_EQ(holes.near_m, 1.0);
  EXPECT_EQ(holes.beyond_m, 3.0);
  EXPECT_EQ(holes.half_width_px, 25.0);
}

TEST(OutlineHolesTest, NothingNearHasNoOutline) {
  const DepthView view{cv::Mat1d(2, 300, 3.0), 525.0, {149.5, 0.5}};
  EXPECT_EQ(MeasureOutlines(view, {0, 2}, 1.5).rows, 0);
}

}  // namespace
}  // namespace fenestra::validation
