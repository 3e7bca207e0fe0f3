#include "sim/structured_light/sensor_unit.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "core/io/input_error.h"
#include "sim/motion/rig_pose.h"
#include "sim/structured_light/structured_light_sensor.h"
#include "tests/sim/structured_light/wall_scenes.h"

namespace fenestra {
namespace {

using testing::Noiseless;
using testing::WhiteWall;

constexpr double kUnitFocalTimesBaseline = 0.075 * 285.63 * 2.0;  // [px m] at 640 x 480

RgbdCalibration Design() {
  return DesignOf(StructuredLightOptions{});
}

// How a unit's parameters differ from its design's, in UnitCovariance's order.
Eigen::VectorXd Differences(const SensorUnit& unit) {
  const RgbdCalibration design = Design();
  Eigen::VectorXd d(kUnitParameters);
  d.head<9>() = unit.cameras.color.ParameterVector() - design.color.ParameterVector();
  const Eigen::AngleAxisd turn(unit.cameras.X_KD.rotation() * design.X_KD.rotation().transpose());
  d.segment<3>(kUnitPose) = turn.angle() * turn.axis();
  d.segment<3>(kUnitPose + 3) = unit.cameras.X_KD.translation() - design.X_KD.translation();
  d.segment<4>(kUnitDepthCamera) =
      unit.cameras.depth.ParameterVector().head<4>() - design.depth.ParameterVector().head<4>();
  const DisparityError& found = unit.disparity;
  d[kUnitScale] = static_cast<double>(found.Of(1.0f, {0, 0}) - 1.0f - found.Of(0.0f, {0, 0}));
  d[kUnitOffset] = static_cast<double>(found.Of(0.0f, {0, 0}));
  return d;
}

TEST(SensorUnitTest, UnitsDifferAsTheirCovarianceSays) {
  constexpr int kUnits = 60;
  for (UnitDeviations deviations : {UnitDeviations::Calibrated(), UnitDeviations::Factory()}) {
    deviations.disparity_warp_px = 0.0;
    const Eigen::MatrixXd covariance = UnitCovariance(Design(), deviations);
    // Without the second focal length of each camera, which is as long as the first.
    const auto is_free = [](int i) { return i != 1 && i != kUnitDepthCamera + 1; };
    double sum = 0.0;
    int freedom = 0;
    Eigen::MatrixXd inverse = covariance;
    for (int i = 0; i < kUnitParameters; ++i) {
      if (is_free(i)) continue;
      inverse.row(i).setZero();
      inverse.col(i).setZero();
      inverse(i, i) = 1.0;
    }
    inverse = inverse.inverse().eval();
    for (uint64_t unit = 0; unit < kUnits; ++unit) {
      Eigen::VectorXd d = Differences(BuildUnit(Design(), deviations, RandomStream(unit)));
      for (int i = 0; i < kUnitParameters; ++i) {
        if (!is_free(i)) d[i] = 0.0;
      }
      sum += d.dot(inverse * d);
      freedom += kUnitParameters - 2;
    }
    // Two-sided, wrong once in 10⁴ for each.
    const boost::math::chi_squared distribution(freedom);
    const auto is_honest = [&](double scale) {
      return scale * sum > quantile(distribution, 5e-5) &&
             scale * sum < quantile(complement(distribution, 5e-5));
    };
    EXPECT_TRUE(is_honest(1.0)) << sum / freedom;
    EXPECT_FALSE(is_honest(1.3));
    EXPECT_FALSE(is_honest(0.75));
  }
}

TEST(SensorUnitTest, WarpHasItsSizeCorrelationAndDensity) {
  const cv::Size image(320, 240);
  constexpr int kUnits = 100;
  double squares = 0.0;
  double products = 0.0;  // Of pixels 60 px of 640 apart.
  double sums2 = 0.0;     // Of the field's mean over the image.
  int count = 0;
  for (uint64_t unit = 0; unit < kUnits; ++unit) {
    const DisparityError error(0.0, 0.0, 0.2, RandomStream(unit), image);
    double sum = 0.0;
    for (int v = 0; v < image.height; v += 4) {
      for (int u = 0; u + 30 < image.width; u += 4) {
        const double w = static_cast<double>(error.Of(0.0f, {u, v}));
        squares += w * w;
        products += w * static_cast<double>(error.Of(0.0f, {u + 30, v}));
        sum += w;
        ++count;
      }
    }
    sums2 += sum * sum;
  }
  // A field has some 30 independent places: 100 of them tell a variance to 3 %.
  EXPECT_NEAR(std::sqrt(squares / count), 0.2, 0.012);
  EXPECT_NEAR(products / squares, std::exp(-1.0), 0.06);
  // The mean's variance is that of the density over the area, but for the image's borders: 15 %
  // less (2 ℓ/√π of 580 and of 480 px); it is known to 14 %.
  const double area_px = 290.0 * 240.0 * 4.0;
  const double per_unit = static_cast<double>(count) / kUnits;
  const double of_mean = sums2 / kUnits / (per_unit * per_unit);
  EXPECT_NEAR(of_mean * area_px / DisparityError::WarpDensity(0.2), 0.87, 0.4);
}

TEST(SensorUnitTest, OffsetAndScaleDisplaceAWallInBothModels) {
  // A unit with an offset of about half a pixel, whatever was drawn, and one with a scale error.
  for (const DepthModel model : {DepthModel::kParametric, DepthModel::kMatched}) {
    StructuredLightOptions options = Noiseless();
    options.depth_model = model;
    options.quantised = false;
    const StructuredLightSensor design(options);
    const RayCaster caster(WhiteWall());
    const Pose X_WB = RigPose({.distance_m = 2.0}, Pose());
    const auto mean_disparity_px = [&](const StructuredLightSensor& sensor) {
      const DepthImage depth = sensor.ObserveDepth(caster, {}, X_WB, RandomStream(1)).depth;
      const cv::Mat1w middle = depth.raw(cv::Rect(100, 80, 120, 80));
      double sum = 0.0;
      for (const uint16_t raw : middle) sum += kUnitFocalTimesBaseline / (raw * depth.unit_m);
      return sum / static_cast<double>(middle.total());
    };
    const double plain_px = mean_disparity_px(design);
    const StructuredLightSensor offset = design.Unit({.disparity_offset_px = 0.5}, RandomStream(3));
    const double offset_px = static_cast<double>(offset.unit().disparity.Of(0.0f, {0, 0}));
    EXPECT_GT(std::abs(offset_px), 0.05);
    EXPECT_NEAR(mean_disparity_px(offset) - plain_px, offset_px, 0.01);
    const StructuredLightSensor scaled = design.Unit({.disparity_scale = 0.03}, RandomStream(3));
    const double scale = static_cast<double>(scaled.unit().disparity.Of(1.0f, {0, 0})) - 1.0;
    EXPECT_GT(std::abs(scale), 0.003) << scale;
    EXPECT_NEAR(mean_disparity_px(scaled) - plain_px, scale * plain_px, 0.01);
  }
}

TEST(SensorUnitTest, WhatIsToldOfAUnitIsItsDesign) {
  for (const bool registered : {false, true}) {
    StructuredLightOptions options;
    options.registered_depth = registered;
    const StructuredLightSensor design(options);
    const StructuredLightSensor unit = design.Unit(UnitDeviations::Factory(), RandomStream(1));
    EXPECT_EQ(unit.nominal(), design.nominal());
    EXPECT_EQ(design.cameras(), design.nominal());
    EXPECT_FALSE(unit.cameras() == unit.nominal());
    EXPECT_EQ(unit.cameras().depth.width_px(), options.depth_width_px);
    // The same unit again, and another.
    EXPECT_EQ(design.Unit(UnitDeviations::Factory(), RandomStream(1)).cameras(), unit.cameras());
    EXPECT_FALSE(design.Unit(UnitDeviations::Factory(), RandomStream(2)).cameras() ==
                 unit.cameras());
    EXPECT_EQ(design.Unit({}, RandomStream(1)).cameras(), design.nominal());
  }
}

TEST(SensorUnitTest, TheLastColumnsAreEmptyAndNoOthers) {
  // 8 columns of 640 and no row, as raw images of Kinects have them.
  for (const DepthModel model : {DepthModel::kParametric, DepthModel::kMatched}) {
    for (const int width_px : {320, 640}) {
      StructuredLightOptions options;
      options.depth_model = model;
      options.depth_width_px = width_px;
      options.depth_height_px = width_px * 3 / 4;
      options.depth_focal_px = 285.63 * width_px / 320;
      const RayCaster caster(WhiteWall());
      const ExplainedDepth seen = StructuredLightSensor(options).ObserveDepth(
          caster, {}, RigPose({.distance_m = 1.5}, Pose()), RandomStream(1));
      const int empty = 8 * width_px / 640;
      for (int u = 0; u < width_px; ++u) {
        const int returns = cv::countNonZero(seen.depth.raw.col(u));
        if (u >= width_px - empty) {
          EXPECT_EQ(returns, 0) << u;
          EXPECT_EQ(cv::countNonZero(seen.no_return.col(u) !=
                                     static_cast<unsigned char>(NoReturn::kBorder)),
                    0);
        } else {
          EXPECT_GT(returns, 0.95 * seen.depth.raw.rows) << u;
        }
      }
    }
  }
}

TEST(SensorUnitTest, NegativeDeviationsAreRefused) {
  EXPECT_THROW(Validate(UnitDeviations{.disparity_scale = -0.1}), InputError);
  EXPECT_THROW(Validate(UnitDeviations{.rotation_rad = std::nan("")}), InputError);
}

}  // namespace
}  // namespace fenestra
