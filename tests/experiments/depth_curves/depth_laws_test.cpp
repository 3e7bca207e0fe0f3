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
  // σ² = dark² + 1/12 with dots of 590 (0.05/0.8)/z² DN: a pattern of variance 0.08 correlates by
  // one half at 1.31 m without shot noise and laser speckle.
  EXPECT_NEAR(PredictedReach({}, 0.05), 1.3, 0.08);
  // Twice the reflectance at √2 times the distance gives the same dots.
  EXPECT_NEAR(PredictedReach({}, 0.10) / PredictedReach({}, 0.05), std::sqrt(2.0), 1e-9);
  // White walls near by are lost to saturation: 590 · 8.45e-6 · 10/0.574 = 0.0868 DN per lux.
  const ReachPrediction near = PredictedAmbientLimit({}, 0.8, 1.0);
  EXPECT_TRUE(near.by_saturation);
  EXPECT_NEAR(near.lux, 1023.0 / 0.0868, 30.0);
  // Dim dots are lost to noise before.
  const ReachPrediction far = PredictedAmbientLimit({}, 0.8, 4.0);
  EXPECT_FALSE(far.by_saturation);
  EXPECT_LT(far.lux, near.lux);
  // A filter of half the width lets half of the light through.
  StructuredLightOptions narrow;
  narrow.infrared.filter_width_nm /= 2.0;
  EXPECT_NEAR(PredictedAmbientLimit(narrow, 0.8, 4.0).lux / far.lux, 2.0, 1e-9);
  // 42.84 px m: 10.7 px for a plate at 2 m before a wall at 4 m.
  EXPECT_NEAR(ShadowWidth({}, 2.0, 4.0), 10.7, 0.05);
}

}  // namespace
}  // namespace fenestra
