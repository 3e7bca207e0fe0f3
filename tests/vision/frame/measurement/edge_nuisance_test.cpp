#include "vision/frame/measurement/edge_nuisance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

const Eigen::Vector2d kNormal(1.0, 0.0);
constexpr double kReach_px = 4.0;
constexpr double kFar_px = 8.0;
constexpr double kBlack_dn = 8.0;
constexpr double kDark_dn = 20.0;
constexpr double kRise_dn = 140.0;

SideRequest Request() {
  return {.side = Side::kRight,
          .border = Border::kOuter,
          .brighter = Brighter::kOutside,
          .reach_px = kReach_px,
          .far_px = kFar_px,
          .min_contrast_dn = 6.0,
          .vignetting = {.black_dn = kBlack_dn, .power = 0.0}};
}

// Strips of 8 rows of pixels along a side, whose grey values are those of the model with this
// tuning. Each strip's edge is at a place of its own between the pixels.
std::vector<EdgeStrip> Strips(const EdgeNuisance& truth, double noise_dn,
                              const RandomStream& stream) {
  const StepModel model(Request(), truth, kNormal);
  std::vector<EdgeStrip> strips;
  constexpr int kStrips = 20;
  uint64_t next = 0;
  for (int i = 0; i < kStrips; ++i) {
    EdgeStrip strip{
        .share = (i + 0.5) / kStrips, .pixel = {100.0, 8.0 * i}, .normal = kNormal, .pixels = {}};
    const StepFit fit{.base_dn = kDark_dn, .rise_dn = kRise_dn, .s0_px = 0.3 * std::sin(1.7 * i)};
    for (int row = 0; row < 8; ++row) {
      for (double s = -kReach_px; s <= kFar_px; s += 1.0) {
        const StepValue value = model.At(fit, strip.share, {s, 0.0});
        const double noise = noise_dn * stream.Normal(next++) / std::sqrt(value.weight);
        strip.pixels.push_back({s, value.grey_dn + noise});
      }
    }
    strips.push_back(strip);
  }
  return strips;
}

// One round: fits with what is known, then what these fits say.
NuisanceEstimate EstimateFrom(const std::vector<EdgeStrip>& strips, const EdgeNuisance& nuisance,
                              double excess = 1.0) {
  const StepModel model(Request(), nuisance, kNormal);
  std::vector<StepFit> fits;
  for (const EdgeStrip& strip : strips) {
    const auto fit = model.Fit(strip);
    EXPECT_TRUE(fit.has_value());
    fits.push_back(fit.value_or(StepFit{}));
  }
  return EstimateNuisance(model, strips, fits, {.excess = excess, .falloff = 0.0}, Request(),
                          nuisance);
}

EdgeNuisance After(const std::vector<EdgeStrip>& strips, int rounds) {
  EdgeNuisance nuisance;
  for (int i = 0; i < rounds; ++i) nuisance = EstimateFrom(strips, nuisance).nuisance;
  return nuisance;
}

TEST(EdgeNuisance, TheBlurThatMadeAPictureIsEstimated) {
  for (const double blur_px : {0.4, 0.5, 0.8}) {
    EdgeNuisance truth;
    truth.shared << blur_px, 0.05, -0.03, 0.0, 0.0;
    const EdgeNuisance learnt = After(Strips(truth, 0.0, RandomStream(1)), 6);
    // Of 2000 pixels those near the edge tell the blur to some thousandths; what was expected of it
    // before, 0.5 px give or take 0.2 px, weighs little beside them.
    EXPECT_NEAR(learnt.blur_px(), blur_px, 0.005) << blur_px;
    EXPECT_NEAR(learnt.blur_change_px(), 0.05, 0.01) << blur_px;
    EXPECT_NEAR(learnt.blur_bend_px(), -0.03, 0.01) << blur_px;
    EXPECT_NEAR(learnt.rise_dn, kRise_dn, 0.01 * kRise_dn) << blur_px;
  }
}

TEST(EdgeNuisance, ASlopeOfTheLightThatPixelsShowIsBelieved) {
  EdgeNuisance truth;
  truth.shared << 0.5, 0.0, 0.0, 0.004, 0.0;
  const EdgeNuisance learnt = After(Strips(truth, 0.0, RandomStream(1)), 8);
  EXPECT_NEAR(learnt.slope_outside(), 0.004, 0.0005);
  EXPECT_NEAR(learnt.slope_inside(), 0.0, 0.0005);
}

TEST(EdgeNuisance, VariancesAreThoseOfEitherSide) {
  EdgeNuisance truth;
  truth.dark_variance = 1.0;
  truth.bright_variance = 4.0;
  const EdgeNuisance learnt = After(Strips(truth, 1.0, RandomStream(2)), 3);
  // Of some 500 pixels inside and 1000 outside: relative deviations √(2/n), four of them.
  EXPECT_NEAR(learnt.dark_variance, 1.0, 4.0 * std::sqrt(2.0 / 500.0));
  EXPECT_NEAR(learnt.bright_variance, 4.0, 4.0 * 4.0 * std::sqrt(2.0 / 1000.0));
}

TEST(EdgeNuisance, ASideIsEvenUnlessFarPixelsFitWorse) {
  const EdgeNuisance truth;
  std::vector<EdgeStrip> strips = Strips(truth, 1.0, RandomStream(3));
  EXPECT_TRUE(EstimateFrom(strips, truth).nuisance.is_even);
  for (EdgeStrip& strip : strips) {
    for (StripPixel& pixel : strip.pixels) {
      if (pixel.s_px > kReach_px + 1.0) pixel.grey_dn += 4.0;
    }
  }
  EXPECT_FALSE(EstimateFrom(strips, truth).nuisance.is_even);
}

TEST(EdgeNuisance, WhatIsNotKnownOfTheNuisanceIsCommonToAllEdges) {
  const EdgeNuisance truth;
  const std::vector<EdgeStrip> strips = Strips(truth, 1.0, RandomStream(4));
  const double usual_px = EstimateFrom(strips, truth).common_sigma_px;
  const double noisy_px = EstimateFrom(strips, truth, 9.0).common_sigma_px;
  EXPECT_GT(usual_px, 0.0);
  // An edge between its two far sides is nearly independent of the blur.
  EXPECT_LT(usual_px, 0.02);
  EXPECT_GT(noisy_px, usual_px);
  EXPECT_LT(noisy_px, 3.0 * usual_px);
}

TEST(EdgeNuisance, AnEstimatedBlurStaysWhereLensesAre) {
  EdgeNuisance truth;
  truth.shared[0] = 2.5;
  EXPECT_LE(After(Strips(truth, 0.0, RandomStream(1)), 12).blur_px(), 1.5);
  truth.shared[0] = 0.05;
  EXPECT_GE(After(Strips(truth, 0.0, RandomStream(1)), 12).blur_px(), 0.25);
}

}  // namespace
}  // namespace fenestra
