#include "experiments/depth_curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

TEST(DepthCurvesTest, PublishedCurvesAreAsPublished) {
  EXPECT_NEAR(KhoshelhamSigma(4.0), 0.0228, 1e-4);
  EXPECT_NEAR(NguyenSigma(2.0, 0.2), 0.0061, 1e-4);
  EXPECT_GT(NguyenSigma(2.0, 1.3), NguyenSigma(2.0, 0.2));
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
    if (at.z_m > 3.0) continue;  // Farther, dots are dimmer than the curve knows.
    EXPECT_NEAR(at.residual_m / KhoshelhamSigma(at.z_m), 1.0, 0.3) << at.z_m;
  }
  // Light and distance only take pixels away.
  const auto share_falls = [](const auto& rows, auto same) {
    for (size_t i = 1; i < rows.size(); ++i) {
      if (!same(rows[i - 1], rows[i])) continue;
      EXPECT_LE(rows[i].valid, rows[i - 1].valid + 0.05);
    }
  };
  share_falls(curves.by_ambient, [](const auto& a, const auto& b) { return a.z_m == b.z_m; });
  share_falls(curves.by_paint, [](const auto& a, const auto& b) {
    return a.reflectance_830nm == b.reflectance_830nm;
  });
}

TEST(DepthCurvesTest, BothModelsStandInOneReport) {
  const DepthCurves parametric =
      MeasureDepthCurves(Small(DepthModel::kParametric), RandomStream(1));
  const DepthCurves speckle = MeasureDepthCurves(Small(DepthModel::kSpeckle), RandomStream(1));
  const std::string report = DepthCurvesMarkdown(parametric, speckle);
  EXPECT_NE(report.find("Khoshelham"), std::string::npos);
  EXPECT_NE(report.find("speckle"), std::string::npos);
  EXPECT_EQ(report.find("nan"), std::string::npos);
  EXPECT_FALSE(DepthCurvesPicture(parametric, speckle).empty());
}

}  // namespace
}  // namespace fenestra
