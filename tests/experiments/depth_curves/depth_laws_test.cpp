#include "experiments/depth_curves/depth_laws.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/depth_curves/depth_curves.h"

namespace fenestra {
namespace {

TEST(DepthLawsTest, PublishedCurvesAreAsPublished) {
  EXPECT_NEAR(KhoshelhamSigma(4.0), 0.0228, 1e-4);
  EXPECT_NEAR(NguyenSigma(2.0, 0.2), 0.0061, 1e-4);
  EXPECT_GT(NguyenSigma(2.0, 1.3), NguyenSigma(2.0, 0.2));
  EXPECT_NEAR(NguyenLateralSigma(0.0), 0.8, 1e-12);
  EXPECT_NEAR(NguyenLateralSigma(0.7854), 0.835, 1e-4);
  EXPECT_NEAR(OpenNiStep(2.0), 0.0114, 1e-4);
  EXPECT_NEAR(MicrosoftStep(2.0), 0.0058, 1e-4);
}

TEST(DepthLawsTest, PredictionsFollowTheConstants) {
  // Dots that are as bright are lost alike: twice the reflectance at √2 times the distance.
  EXPECT_NEAR(PredictedReach({}, 0.10) / PredictedReach({}, 0.05), std::sqrt(2.0), 1e-6);
  // In the dark, and almost without shot noise, the reach goes with the root of the noise.
  StructuredLightOptions noisy;
  noisy.infrared.dark_noise_dn *= 4.0;
  noisy.infrared.shot_noise_dn = 0.0;
  StructuredLightOptions quiet = noisy;
  quiet.infrared.dark_noise_dn /= 4.0;
  EXPECT_NEAR(PredictedReach(quiet, 0.05) / PredictedReach(noisy, 0.05), 2.0, 0.03);
  // In strong light, shot noise of an exposure as long as it can be decides. That exposure is
  // t ~ 1/a, and dots are lost where (s t)² < k c a t, where s is below a share of a. Dots go with
  // 1/z².
  const double near_lx = PredictedAmbientLimit({}, 0.8, 1.0);
  const double far_lx = PredictedAmbientLimit({}, 0.8, 2.0);
  EXPECT_NEAR(near_lx / far_lx, 4.0, 0.1);
  // Dots and daylight are weakened alike by half the power with half the filter.
  StructuredLightOptions weak;
  weak.infrared.projector_power_w /= 2.0;
  weak.infrared.filter_width_nm /= 2.0;
  EXPECT_NEAR(PredictedAmbientLimit(weak, 0.8, 2.0) / far_lx, 1.0, 1e-6);
  // 42.84 px m: 10.7 px for a plate at 2 m before a wall at 4 m.
  EXPECT_NEAR(ShadowWidth({}, 2.0, 4.0), 10.7, 0.05);
}

}  // namespace
}  // namespace fenestra
