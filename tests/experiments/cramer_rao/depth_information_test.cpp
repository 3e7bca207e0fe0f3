#include "experiments/cramer_rao/depth_information.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <boost/math/distributions/chi_squared.hpp>

#include "core/geometry/pose.h"
#include "experiments/cramer_rao/trial_information.h"
#include "scenes/targets/flat_targets.h"
#include "sim/motion/rig_pose.h"

namespace fenestra {
namespace {

constexpr double kBorder_m = 0.1;

// A wall of which everything returns dots, and a frame on it.
class WallBefore {
 public:
  explicit WallBefore(double distance_m, double frame_reflectance_830nm = 0.8,
                      const UnitDeviations& deviations = {}, uint64_t unit = 0)
      : scene_(MakePaperTarget({.frame_reflectance_830nm = frame_reflectance_830nm})),
        caster_(scene_),
        sensor_(
            StructuredLightSensor(StructuredLightOptions{}).Unit(deviations, RandomStream(unit))),
        theory_(sensor_),
        X_WB_(RigPose({.distance_m = distance_m, .azimuth_rad = 8.0 * kDegree}, Pose())),
        frame_(FrameState::Of(*sensor_.Truth(scene_, X_WB_).target, kBorder_m)) {
    lighting_.sky.illuminance_lx = 500.0;
  }

  const FrameState& frame() const { return frame_; }
  RgbdObservation Observe(uint64_t shot) const {
    return sensor_.Observe(caster_, lighting_, X_WB_, RandomStream(shot));
  }
  DepthImage Depth(uint64_t shot) const {
    return sensor_.ObserveDepth(caster_, lighting_, X_WB_, RandomStream(shot)).depth;
  }
  DepthMatrix Information(const DepthImage& seen) const {
    return theory_.Information(frame_, 0.0, seen, caster_, lighting_, X_WB_);
  }
  Eigen::MatrixXd Information(const RgbdObservation& seen) const {
    return RgbdInformation(frame_, sensor_, seen.color, Information(seen.depth)).value();
  }
  double focal_times_baseline() const { return 285.63 * 2.0 * 0.075; }
  const CameraModel& camera() const { return sensor_.nominal().depth; }

 private:
  Scene scene_;
  RayCaster caster_;
  StructuredLightSensor sensor_;
  DepthTheory theory_;
  Pose X_WB_;
  FrameState frame_;
  Lighting lighting_;
};

// How far the plane that fits the depth image's disparities best is off at the frame's centre,
// along its normal.
double PlaneError(const WallBefore& wall, const DepthImage& seen) {
  const CameraParameters& k = wall.camera().parameters();
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (int v = 0; v < seen.raw.rows; ++v) {
    for (int u = 0; u < seen.raw.cols; ++u) {
      if (seen.raw(v, u) == 0) continue;
      const Eigen::Vector3d r((u - k.cx_px) / k.fx_px, (v - k.cy_px) / k.fy_px, 1.0);
      normal += r * r.transpose();
      right += r * (1.0 / (seen.raw(v, u) * seen.unit_m));
    }
  }
  const Eigen::Vector3d plane = normal.ldlt().solve(right);  // 1/z = plane·r.
  const Eigen::Vector3d p_CO = wall.frame().X_CO.translation();
  const double z_m = p_CO.z() / plane.dot(p_CO);  // On the ray p_CO/z.
  const Eigen::Vector3d n = wall.frame().X_CO.rotation().col(2);
  return (z_m / p_CO.z() - 1.0) * n.dot(p_CO);
}

// The bound on that, the plane's tilt being unknown. `unit`: covariance of the sensor's parameters.
double PlaneBound_m2(const WallBefore& wall, const DepthMatrix& information,
                     const Eigen::MatrixXd& unit = Eigen::MatrixXd::Zero(kUnitParameters,
                                                                         kUnitParameters)) {
  const Eigen::Matrix3d R = wall.frame().X_CO.rotation();
  const Eigen::MatrixXd known = WithNuisance(information, kUnitUnknown, unit);
  const Eigen::Index nuisance = known.rows() - kUnitUnknown;
  Eigen::MatrixXd by_unknown = Eigen::MatrixXd::Zero(known.rows(), 3 + nuisance);
  by_unknown.block<3, 1>(0, 0) = R.col(2);
  by_unknown.block<3, 2>(3, 1) = R.leftCols<2>();
  by_unknown.bottomRightCorner(nuisance, nuisance).setIdentity();
  return (by_unknown.transpose() * known * by_unknown).inverse()(0, 0);
}

// Whether errors are as large as this variance at least: their normalised sum is χ², and less than
// that by chance once in a thousand.
bool ReachesBound(double normalised_sum, int count) {
  return normalised_sum > quantile(boost::math::chi_squared(count), 1e-3);
}

TEST(DepthInformationTest, PlanesFittedToTheSensorsDepthDoNotBeatTheBoundAndComeNear) {
  constexpr int kShots = 30;
  for (const double distance_m : {1.5, 2.5}) {
    const WallBefore wall(distance_m);
    const double bound_m2 = PlaneBound_m2(wall, wall.Information(wall.Depth(0)));
    double sum = 0.0;
    for (int shot = 0; shot < kShots; ++shot) {
      const double error_m = PlaneError(wall, wall.Depth(static_cast<uint64_t>(shot)));
      sum += error_m * error_m / bound_m2;
    }
    EXPECT_TRUE(ReachesBound(sum, kShots)) << sum / kShots << " at " << distance_m << " m";
    // The twin with a fault: a bound of ten times the variance.
    EXPECT_FALSE(ReachesBound(0.1 * sum, kShots)) << sum / kShots << " at " << distance_m << " m";
  }
}

TEST(DepthInformationTest, UnitsOfASensorDoNotBeatTheBoundThatKnowsTheirDeviations) {
  constexpr int kUnits = 30;
  const UnitDeviations deviations = UnitDeviations::Calibrated();
  const Eigen::MatrixXd covariance = UnitCovariance(DesignOf(StructuredLightOptions{}), deviations);
  double sum = 0.0;
  double sum_without = 0.0;
  for (uint64_t unit = 0; unit < kUnits; ++unit) {
    const WallBefore wall(2.0, 0.8, deviations, unit);
    const DepthImage seen = wall.Depth(unit);
    const DepthMatrix information = wall.Information(seen);
    const double error_m = PlaneError(wall, seen);
    sum += error_m * error_m / PlaneBound_m2(wall, information, covariance);
    sum_without += error_m * error_m / PlaneBound_m2(wall, information);
  }
  // A plane fitted without regard to the warp is near the best that can be done. Twice the
  // variance is far outside the 99.9 % interval of χ².
  EXPECT_TRUE(ReachesBound(sum, kUnits)) << sum / kUnits;
  EXPECT_LT(sum, 2.0 * kUnits);
  // The twin with a fault: a bound for which all but the warp is known exactly.
  EXPECT_GT(sum_without, 5.0 * kUnits);
}

TEST(DepthInformationTest, AnOffsetOfDisparitiesAddsItsShareOfDepth) {
  const WallBefore wall(2.0);
  const DepthMatrix information = wall.Information(wall.Depth(0));
  const auto added_m2 = [&](const UnitDeviations& deviations) {
    return PlaneBound_m2(wall, information,
                         UnitCovariance(DesignOf(StructuredLightOptions{}), deviations)) -
           PlaneBound_m2(wall, information);
  };
  // δz = z²/(f b) δd, along the normal, which is 8° from the line of sight.
  const double z_m = wall.frame().X_CO.translation().z();
  const double by_offset_m = z_m * z_m / wall.focal_times_baseline() * std::cos(8.0 * kDegree);
  const double offset = added_m2({.disparity_offset_px = 0.1});
  EXPECT_NEAR(offset / std::pow(0.1 * by_offset_m, 2), 1.0, 0.02);
  // δz = z s.
  const double scale = added_m2({.disparity_scale = 0.01});
  EXPECT_NEAR(scale / std::pow(0.01 * z_m * std::cos(8.0 * kDegree), 2), 1.0, 0.02);
}

TEST(DepthInformationTest, FallsWithDistanceAndWithWhatReturns) {
  const WallBefore near(1.5);
  const WallBefore far(3.0);
  const DepthImage seen = near.Depth(0);
  const double near_m2 = PlaneBound_m2(near, near.Information(seen));
  EXPECT_GT(PlaneBound_m2(far, far.Information(far.Depth(0))), 4.0 * near_m2);
  DepthImage half = seen;
  half.raw = seen.raw.clone();
  half.raw.rowRange(0, seen.raw.rows / 2).setTo(0);
  EXPECT_GT(PlaneBound_m2(near, near.Information(half)), 1.5 * near_m2);
  DepthImage none = seen;
  none.raw = cv::Mat1w::zeros(seen.raw.size());
  EXPECT_EQ(near.Information(none).norm(), 0.0);
}

TEST(RgbdInformationTest, WhatIsKnownTightensTheBound) {
  const WallBefore black(2.0, 0.005);
  const RgbdObservation seen = black.Observe(1);
  const Eigen::MatrixXd information = black.Information(seen);
  const auto variance_z = [&](const PriorKnowledge& knowledge) {
    return RgbdBound(information, knowledge).value()(2, 2);
  };
  const double plain = variance_z({});
  const double sized = variance_z({.size_sigma_m = 1e-6, .calibration = {}, .wall_sigma_m = {}});
  EXPECT_LT(sized, plain);
  // A wall that may be anywhere tells how the frame is turned, but not how far it is away.
  const double free = variance_z({.size_sigma_m = {}, .calibration = {}, .wall_sigma_m = 0.05});
  // Along the line of sight, which meets the wall at 8°, it is 2 % more of a variance.
  EXPECT_NEAR(free - plain, 0.05 * 0.05, 0.1 * 0.05 * 0.05);
}

TEST(RgbdInformationTest, WithoutReturnsOnlyTheSizeTellsTheDistance) {
  const WallBefore wall(2.0);
  RgbdObservation seen = wall.Observe(1);
  seen.depth.raw = cv::Mat1w::zeros(seen.depth.raw.size());
  const Eigen::MatrixXd information = wall.Information(seen);
  EXPECT_FALSE(RgbdBound(information, {}).has_value());
  EXPECT_TRUE(
      RgbdBound(information, {.size_sigma_m = 1e-3, .calibration = {}, .wall_sigma_m = {}}));
}

}  // namespace
}  // namespace fenestra
