#include "experiments/depth_curves/depth_curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/depth_curves/depth_laws.h"
#include "experiments/depth_curves/wall_setup.h"

namespace fenestra {
namespace {

// Images of a quarter of the width, so that a test can afford them.
StructuredLightOptions Small(DepthModel model) {
  StructuredLightOptions options;
  options.depth_model = model;
  options.driver = DepthDriver::kOpenNi;
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
    EXPECT_NEAR(at.residual_m / KhoshelhamSigma(at.z_m), 1.0, 0.45) << at.z_m;
  }
  // Light and distance only take pixels away.
  const auto share_falls = [](const auto& rows, auto same) {
    for (size_t i = 1; i < rows.size(); ++i) {
      if (!same(rows[i - 1], rows[i])) continue;
      EXPECT_LE(rows[i].valid, rows[i - 1].valid + 0.05);
    }
  };
  // Within a factor of two of where the configured constants say; none of them was fitted to it.
  for (const double z_m : {2.0, 3.0}) {  // No daylight drowns the dots at 1 m.
    std::vector<cv::Point2d> shares;
    for (const auto& at : curves.by_ambient) {
      if (at.z_m == z_m) shares.emplace_back(at.wall_lx, at.valid);
    }
    const double predicted =
        PredictedAmbientLimit(Small(DepthModel::kParametric), WallSetup::kWhite, z_m);
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

TEST(DepthCurvesTest, HalfPointsLieBetweenTheSamplesAroundThem) {
  const std::vector<cv::Point2d> shares = {{1.0, 1.0}, {10.0, 0.75}, {1000.0, 0.25}, {1e4, 0.0}};
  EXPECT_NEAR(HalfPoint(shares), 100.0, 1e-9);
  EXPECT_TRUE(std::isnan(HalfPoint({{1.0, 1.0}, {2.0, 0.6}})));
}

}  // namespace
}  // namespace fenestra
