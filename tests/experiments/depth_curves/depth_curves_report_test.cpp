#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/depth_curves/depth_curves_picture.h"
#include "experiments/depth_curves/depth_curves_report.h"

namespace fenestra {
namespace {

// Images of a quarter of the width, so that a test can afford them.
StructuredLightOptions SmallSensor(DepthModel model) {
  StructuredLightOptions options;
  options.depth_model = model;
  options.depth_width_px = 80;
  options.depth_height_px = 60;
  options.depth_focal_px /= 4.0;
  options.infrared_width_px = 160;
  return options;
}

TEST(DepthCurvesReportTest, BothModelsStandInOneReport) {
  const DepthCurves parametric =
      MeasureDepthCurves(SmallSensor(DepthModel::kParametric), RandomStream(1));
  const DepthCurves speckle =
      MeasureDepthCurves(SmallSensor(DepthModel::kMatched), RandomStream(1));
  const std::string report =
      DepthCurvesMarkdown(SmallSensor(DepthModel::kParametric), parametric, speckle);
  EXPECT_NE(report.find("Khoshelham"), std::string::npos);
  EXPECT_NE(report.find("speckle"), std::string::npos);
  EXPECT_EQ(report.find("nan"), std::string::npos);
  EXPECT_FALSE(DepthCurvesPicture(parametric, speckle).empty());
}

}  // namespace
}  // namespace fenestra
