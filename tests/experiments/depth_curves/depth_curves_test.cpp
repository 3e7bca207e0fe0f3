#include "experiments/depth_curves/depth_curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/depth_curves/depth_laws.h"
#include "experiments/depth_curves/wall_setup.h"

namespace fenestra {
namespace {

TEST(DepthCurvesTest, PublishedCurvesAreAsPublished) {
  EXPECT_NEAR(KhoshelhamSigma(4.0), 0.0228, 1e-4);
  EXPECT_NEAR(NguyenSigma(2.0, 0.2), 0.0061, 1e-4);
  EXPECT_GT(NguyenSigma(2.0, 1.3), NguyenSigma(2.0, 0.2));
  EXPECT_NEAR(NguyenLateralSigma(0.0), 0.8, 1e-12);
  EXPECT_NEAR(NguyenLateralSigma(0.7854), 0.835, 1e-4);
  EXPECT_NEAR(OpenNiStep(2.0), 0.0114, 1e-4);
  EXPECT_NEAR(MicrosoftStep(2.0), 0.0058, 1e-4);
}

// Images of a quarter of the width, so that a test can afford them.
StructuredLightOptions Small(DepthModel model) {
  StructuredLightOptions options;
  options.depth_model = model;
  options.depth_width_px = 80;
  options.depth_height_px = 60;
  options.depth_focal_px /= 4.0;
  options.infrared_width_px = 160;
  return options;
}

TEST(DepthCurvesTest, TheParametricModelLosesReturnsToLightAndDistance) {
  const DepthCurves curves = MeasureDepthCurves(Small(DepthModel::kParametric), RandomStream(1));
  for (const DepthCurves::Distance& at : curves.by_distance) {
    // A fixed pattern is a part of the residual.
    EXPECT_LT(at.temporal_m, at.residual_m) << at.z_m;
    if (at.z_m > 2.5) continue;  // Farther, dots are dimmer than the curve knows.
    EXPECT_NEAR(at.residual_m / KhoshelhamSigma(at.z_m), 1.0, 0.3) << at.z_m;
  }
  // Light and distance only take pixels away.
  const auto share_falls = [](const auto& rows, auto same) {
    for (size_t i = 1; i < rows.size(); ++i) {
      if (!same(rows[i - 1], rows[i])) continue;
      EXPECT_LE(rows[i].valid, rows[i - 1].valid + 0.05);
    }
  };
  // Within a factor of two of where the configured constants say; none of them was fitted to it.
  for (const double z_m : {1.0, 2.0, 3.0}) {
    std::vector<cv::Point2d> shares;
    for (const auto& at : curves.by_ambient) {
      if (at.z_m == z_m) shares.emplace_back(at.wall_lx, at.valid);
    }
    const double predicted = PredictedAmbientLimit({}, WallSetup::kWhite, z_m).lux;
    EXPECT_LT(std::abs(std::log2(HalfPoint(shares) / predicted)), 1.0) << z_m;
  }
  // The disparities that occur are multiples of a fixed step: z²/(f b) steps, whatever the image.
  for (const DepthCurves::Step& at : curves.steps) {
    EXPECT_NEAR(at.open_ni_m / OpenNiStep(at.z_m), 1.0, 0.08) << at.z_m;
    EXPECT_NEAR(at.microsoft_m / MicrosoftStep(at.z_m), 1.0, 0.08) << at.z_m;
  }
  share_falls(curves.by_ambient, [](const auto& a, const auto& b) { return a.z_m == b.z_m; });
  share_falls(curves.by_paint, [](const auto& a, const auto& b) {
    return a.reflectance_830nm == b.reflectance_830nm;
  });
}

TEST(DepthCurvesTest, PredictionsFollowTheConstants) {
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

TEST(DepthCurvesTest, HalfPointsLieBetweenTheSamplesAroundThem) {
  const std::vector<cv::Point2d> shares = {{1.0, 1.0}, {10.0, 0.75}, {1000.0, 0.25}, {1e4, 0.0}};
  EXPECT_NEAR(HalfPoint(shares), 100.0, 1e-9);
  EXPECT_TRUE(std::isnan(HalfPoint({{1.0, 1.0}, {2.0, 0.6}})));
}

TEST(DepthCurvesTest, BothModelsStandInOneReport) {
  const DepthCurves parametric =
      MeasureDepthCurves(Small(DepthModel::kParametric), RandomStream(1));
  const DepthCurves speckle = MeasureDepthCurves(Small(DepthModel::kMatched), RandomStream(1));
  const std::string report =
      DepthCurvesMarkdown(Small(DepthModel::kParametric), parametric, speckle);
  EXPECT_NE(report.find("Khoshelham"), std::string::npos);
  EXPECT_NE(report.find("speckle"), std::string::npos);
  EXPECT_EQ(report.find("nan"), std::string::npos);
  EXPECT_FALSE(DepthCurvesPicture(parametric, speckle).empty());
}

}  // namespace
}  // namespace fenestra
