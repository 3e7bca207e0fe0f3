#include "tests/vision/rgbd/synthetic_kinect.h"

#include <cmath>

namespace fenestra::testing {
namespace {

constexpr double kFocalBaselinePxM = 571.26 * 0.075;
constexpr double kDisparityNoisePx = 0.05;
constexpr double kDisparityStepPx = 0.125;

double Measured(double z_m, double normal) {
  const double disparity_px = kFocalBaselinePxM / z_m + kDisparityNoisePx * normal;
  return kFocalBaselinePxM / (kDisparityStepPx * std::round(disparity_px / kDisparityStepPx));
}

}  // namespace

RgbdCalibration KinectCalibration() {
  return {.color = CameraModel::Pinhole(640, 480, 531.15),
          .depth = CameraModel::Pinhole(320, 240, 285.63),
          .X_KD = Pose::Translation({-0.025, 0.0, 0.0}),
          .depth_unit_m = 0.001};
}

RgbdCalibration RegisteredCalibration() {
  return {.color = CameraModel::Pinhole(640, 480, 525.0),
          .depth = CameraModel::Pinhole(640, 480, 525.0),
          .X_KD = Pose(),
          .depth_unit_m = 0.001};
}

RgbdObservation Observe(const RgbdCalibration& calibration, const SyntheticKinect& scene,
                        const std::optional<RandomStream>& noise) {
  RgbdObservation observation;
  observation.depth.unit_m = calibration.depth_unit_m;
  const Pose X_KO = calibration.X_KD * scene.X_DO;
  const cv::Mat1f coverage = BorderCoverage(calibration.color, X_KO, scene.target, 2);
  observation.color.create(coverage.size());
  for (int v = 0; v < coverage.rows; ++v) {
    for (int u = 0; u < coverage.cols; ++u) {
      const double dn = scene.wall_dn + coverage(v, u) * (scene.frame_dn - scene.wall_dn);
      observation.color(v, u) = cv::Vec3b::all(static_cast<uchar>(std::lround(dn)));
    }
  }
  const cv::Mat1f depth_m = PlaneDepth(calibration.depth, scene.X_DO);
  observation.depth.raw = cv::Mat1w::zeros(depth_m.size());
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const auto index = static_cast<uint64_t>(v * depth_m.cols + u);
      const double z_m = depth_m(v, u);
      if (!(z_m > 0.0)) continue;
      const double found_m = noise ? Measured(z_m, noise->Normal(index)) : z_m;
      observation.depth.raw(v, u) =
          cv::saturate_cast<ushort>(std::lround(found_m / calibration.depth_unit_m));
    }
  }
  return observation;
}

Pose PoseOfWindow(const Look& look) {
  const Pose X_AO(RotationFromVector({0.0, look.azimuth_rad, 0.0}), Eigen::Vector3d::Zero());
  const Pose yaw(RotationFromVector({0.0, look.yaw_rad, 0.0}), Eigen::Vector3d::Zero());
  const Pose roll(RotationFromVector({0.0, 0.0, look.roll_rad}), Eigen::Vector3d::Zero());
  return roll * yaw * FacingWindow(look.distance_m) * X_AO;
}

}  // namespace fenestra::testing
