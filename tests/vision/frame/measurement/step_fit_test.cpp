#include "vision/frame/measurement/step_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

using Eigen::Vector2d;

constexpr double kStepReach_px = 4.0;

SideRequest StepRequest(Brighter brighter = Brighter::kOutside) {
  return {.side = Side::kRight,
          .border = Border::kOuter,
          .brighter = brighter,
          .reach_px = kStepReach_px,
          .far_px = kStepReach_px,
          .min_contrast_dn = 6.0,
          .vignetting = {.black_dn = 8.0, .power = 0.0}};
}

// Eight rows of pixels with the model's own grey values, and noise.
EdgeStrip StripOf(const StepModel& model, const StepFit& fit, double noise_dn = 0.0,
                  uint64_t seed = 1) {
  EdgeStrip strip{.share = 0.3, .pixel = {100.0, 80.0}, .normal = {1.0, 0.0}, .pixels = {}};
  const RandomStream stream(seed);
  uint64_t next = 0;
  for (int row = 0; row < 8; ++row) {
    for (double s = -kStepReach_px; s <= kStepReach_px; s += 1.0) {
      const double grey = model.At(fit, strip.share, {s, 0.0}).grey_dn;
      strip.pixels.push_back({s, std::min(255.0, grey + noise_dn * stream.Normal(next++))});
    }
  }
  return strip;
}

// The definition, integrated over the pixel's square and the Gaussian by a fine sum.
double ShareByDefinition(double s_px, double sigma_px, double angle) {
  constexpr int kSteps = 200;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    for (int k = 0; k < kSteps; ++k) {
      const double u = (i + 0.5) / kSteps - 0.5;
      const double v = (k + 0.5) / kSteps - 0.5;
      const double d = s_px + u * std::cos(angle) + v * std::sin(angle);
      sum += 0.5 * std::erfc(-d / (sigma_px * std::numbers::sqrt2));
    }
  }
  return sum / (kSteps * kSteps);
}

TEST(BlurredStep, IsTheShareOfTheOuterAreaInAPixel) {
  for (const double angle : {0.0, 0.5 * std::numbers::pi, 0.3, 0.25 * std::numbers::pi}) {
    const BlurredStep step(0.5, Vector2d(std::cos(angle), std::sin(angle)));
    for (const double s : {-2.0, -0.7, -0.1, 0.0, 0.4, 1.5}) {
      // Exact along rows and columns; the narrow side's box has only its variance kept.
      const double tolerance = std::abs(std::sin(2.0 * angle)) < 1e-9 ? 2e-4 : 2e-3;
      EXPECT_NEAR(step.At(s).p, ShareByDefinition(s, 0.5, angle), tolerance) << angle << ", " << s;
    }
  }
}

TEST(BlurredStep, IsOneHalfOnTheEdgeAndSymmetricAboutIt) {
  const BlurredStep step(0.6, Vector2d(0.8, 0.6));
  EXPECT_NEAR(step.At(0.0).p, 0.5, 1e-4);
  for (const double s : {0.3, 1.0, 2.2}) {
    EXPECT_NEAR(step.At(s).p + step.At(-s).p, 1.0, 2e-4);
    EXPECT_NEAR(step.At(s).ramp - step.At(-s).ramp, s, 2e-3);
  }
  EXPECT_EQ(step.At(-20.0).p, 0.0);
  EXPECT_EQ(step.At(20.0).p, 1.0);
  EXPECT_EQ(step.At(20.0).ramp, 20.0);
}

TEST(BlurredStep, DerivativesAreThoseOfItsValue) {
  const Vector2d normal(0.8, 0.6);
  constexpr double kChange = 0.05;
  for (const double s : {-0.8, -0.2, 0.0, 0.5, 1.1}) {
    const BlurredStep::Value value = BlurredStep(0.5, normal).At(s);
    const double by_s =
        (BlurredStep(0.5, normal).At(s + kChange).p - BlurredStep(0.5, normal).At(s - kChange).p) /
        (2.0 * kChange);
    const double by_sigma =
        (BlurredStep(0.55, normal).At(s).p - BlurredStep(0.45, normal).At(s).p) / 0.1;
    // Second-order errors of the quotients, and the table's own.
    EXPECT_NEAR(value.by_s, by_s, 0.005) << s;
    EXPECT_NEAR(value.by_sigma, by_sigma, 0.01) << s;
  }
}

TEST(StepFit, WhatTheModelDrewIsFoundAgain) {
  EdgeNuisance nuisance;
  nuisance.shared << 0.6, 0.05, -0.04, 0.003, -0.002;
  for (const Brighter brighter : {Brighter::kOutside, Brighter::kInside}) {
    const StepModel model(StepRequest(brighter), nuisance, Vector2d(1.0, 0.0));
    const double rise_dn = brighter == Brighter::kOutside ? 140.0 : -140.0;
    const double base_dn = brighter == Brighter::kOutside ? 20.0 : 160.0;
    for (const double s0_px : {-1.3, -0.2, 0.0, 0.45, 1.8}) {
      const StepFit truth{.base_dn = base_dn, .rise_dn = rise_dn, .s0_px = s0_px};
      const auto found = model.Fit(StripOf(model, truth));
      ASSERT_TRUE(found.has_value()) << s0_px;
      // A last step below 1e-3 px leaves the square of that over the blur.
      EXPECT_NEAR(found->s0_px, s0_px, 2e-3);
      EXPECT_NEAR(found->base_dn, base_dn, 0.3);
      EXPECT_NEAR(found->rise_dn, rise_dn, 0.6);
    }
  }
}

TEST(StepFit, VarianceIsHonest) {
  // The mean of 500 normalised squares is 1 with a deviation of √(2/500) = 6 %; four of them.
  const EdgeNuisance nuisance;
  const StepModel model(StepRequest(), nuisance, Vector2d(1.0, 0.0));
  const StepFit truth{.base_dn = 20.0, .rise_dn = 140.0, .s0_px = 0.3};
  double sum = 0.0;
  constexpr int kFits = 500;
  for (uint64_t i = 0; i < kFits; ++i) {
    const auto found = model.Fit(StripOf(model, truth, 1.0, i));
    ASSERT_TRUE(found.has_value());
    sum += std::pow(found->s0_px - 0.3, 2) / found->s0_variance;
  }
  EXPECT_NEAR(sum / kFits, 1.0, 0.25);
  // The twin: twice the noise that the weights say.
  double noisy = 0.0;
  for (uint64_t i = 0; i < kFits; ++i) {
    const auto found = model.Fit(StripOf(model, truth, 2.0, i));
    if (found) noisy += std::pow(found->s0_px - 0.3, 2) / found->s0_variance;
  }
  EXPECT_GT(noisy / kFits, 2.0);
}

TEST(StepFit, ResidualsAreMeasuredByTheWeights) {
  EdgeNuisance nuisance;
  const StepModel model(StepRequest(), nuisance, Vector2d(1.0, 0.0));
  const StepFit truth{.base_dn = 20.0, .rise_dn = 140.0, .s0_px = 0.3};
  double sum = 0.0;
  for (uint64_t i = 0; i < 50; ++i) sum += model.Fit(StripOf(model, truth, 1.0, i))->mean_square;
  // 50 fits of 72 pixels less 3: √(2/3450) = 2.4 %.
  EXPECT_NEAR(sum / 50.0, 1.0, 0.1);
}

TEST(StepFit, PixelsAtFullScaleMoveNoEdge) {
  EdgeNuisance nuisance;
  nuisance.rise_dn = 300.0;
  const StepModel model(StepRequest(), nuisance, Vector2d(1.0, 0.0));
  // The wall is brighter than the sensor can say.
  const StepFit truth{.base_dn = 20.0, .rise_dn = 300.0, .s0_px = 0.2};
  const auto found = model.Fit(StripOf(model, truth));
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->s0_px, 0.2, 0.01);
  // Where there are none, the steps of the rest of the side are not asked.
  const StepFit dim{.base_dn = 20.0, .rise_dn = 100.0, .s0_px = 0.2};
  EXPECT_EQ(model.PriorInformation(StripOf(model, dim)).norm(), 0.0);
  EXPECT_GT(model.PriorInformation(StripOf(model, truth))(1, 1), 0.0);
}

TEST(StepFit, AWeakReversedOrFarEdgeIsNone) {
  const EdgeNuisance nuisance;
  const StepModel model(StepRequest(), nuisance, Vector2d(1.0, 0.0));
  EXPECT_FALSE(model.Fit(StripOf(model, {.base_dn = 20.0, .rise_dn = 5.0, .s0_px = 0.0})));
  EXPECT_FALSE(model.Fit(StripOf(model, {.base_dn = 160.0, .rise_dn = -140.0, .s0_px = 0.0})));
  EXPECT_FALSE(model.Fit(StripOf(model, {.base_dn = 20.0, .rise_dn = 140.0, .s0_px = 3.5})));
  EXPECT_FALSE(model.Fit({.share = 0.5, .pixel = {0, 0}, .normal = {1, 0}, .pixels = {}}));
}

}  // namespace
}  // namespace fenestra
