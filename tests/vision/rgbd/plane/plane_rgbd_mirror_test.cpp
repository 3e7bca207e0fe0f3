#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/mirrored_estimate.h"
#include "tests/vision/rgbd/plane/exact_kinect.h"
#include "tests/vision/rgbd/synthetic_kinect.h"
#include "vision/rgbd/plane/plane_rgbd.h"

// Mirrored: x -> -x for the world, all pixels and both cameras.

namespace fenestra {
namespace {

using testing::ExactKinectScene;
using testing::KinectCalibration;
using testing::Look;
using testing::PoseOfWindow;
using testing::RegisteredCalibration;

Detection DetectBeside(const RgbdCalibration& calibration, const RgbdObservation& observation) {
  StageLog log(SteadyClock());
  return PlaneRgbdDetector(calibration, {}).Detect(observation, log);
}

WindowEstimate EstimateIn(const Detection& detection) {
  const auto* estimate = std::get_if<WindowEstimate>(&detection);
  EXPECT_NE(estimate, nullptr) << std::get<Miss>(detection).detail;
  return estimate == nullptr ? WindowEstimate{} : *estimate;
}

RgbdCalibration Mirrored(const RgbdCalibration& calibration) {
  const auto mirrored = [](const CameraModel& camera) {
    CameraParameters p = camera.parameters();
    p.cx_px = p.width_px - 1 - p.cx_px;
    return CameraModel(p);
  };
  const Eigen::Vector3d& t = calibration.X_KD.translation();
  return {mirrored(calibration.color), mirrored(calibration.depth),
          Pose::Translation({-t.x(), t.y(), t.z()}), calibration.depth_unit_m};
}

RgbdObservation Mirrored(const RgbdObservation& seen) {
  RgbdObservation mirrored{.color = {}, .depth = {.raw = {}, .unit_m = seen.depth.unit_m}};
  cv::flip(seen.color, mirrored.color, 1);
  cv::flip(seen.depth.raw, mirrored.depth.raw, 1);
  return mirrored;
}

double LargestDifference(const WindowEstimate& one, const WindowEstimate& mirrored) {
  return testing::DistanceFromMirrored(one, 0.0, mirrored);
}

// Rounding, see edge_stereo_mirror_test.cpp; 1e-8 m has been seen.
constexpr double kRounding_m = 1e-7;

struct MirrorSight {
  Look look;
  bool registered = false;
};
class PlaneRgbdMirror : public ::testing::TestWithParam<MirrorSight> {};

TEST_P(PlaneRgbdMirror, MirroredImagesMirrorTheEstimateExactly) {
  const RgbdCalibration calibration =
      GetParam().registered ? RegisteredCalibration() : KinectCalibration();
  ExactKinectScene scene;
  scene.frame.X_LO = PoseOfWindow(GetParam().look);
  const testing::ExactKinectPicture picture = testing::ExactPicture(calibration, scene);
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    const RgbdObservation seen = testing::WithNoise(picture, calibration, {}, RandomStream(seed));
    const WindowEstimate one = EstimateIn(DetectBeside(calibration, seen));
    const WindowEstimate other = EstimateIn(DetectBeside(Mirrored(calibration), Mirrored(seen)));
    EXPECT_LT(LargestDifference(one, other), kRounding_m) << seed;
    EXPECT_NEAR(other.covariance_C->trace() / one.covariance_C->trace(), 1.0, 1e-6);
    // The twin with a fault: other cameras' colour image, off by a hundredth of a pixel.
    RgbdCalibration shifted = calibration;
    CameraParameters p = calibration.color.parameters();
    p.cx_px += 0.01;
    shifted.color = CameraModel(p);
    EXPECT_GT(LargestDifference(EstimateIn(DetectBeside(shifted, seen)), other), kRounding_m)
        << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Views, PlaneRgbdMirror,
    ::testing::Values(MirrorSight{{.distance_m = 1.5, .azimuth_rad = 0.05}},
                      MirrorSight{{.distance_m = 2.0, .azimuth_rad = 0.05, .roll_rad = 0.1}},
                      MirrorSight{{.distance_m = 2.5, .azimuth_rad = 0.8, .yaw_rad = 0.05}},
                      MirrorSight{{.distance_m = 3.5, .azimuth_rad = -0.5, .roll_rad = -0.2}},
                      MirrorSight{{.distance_m = 2.0, .azimuth_rad = -0.4}, true},
                      MirrorSight{{.distance_m = 3.0, .azimuth_rad = 0.1}, true}));

}  // namespace
}  // namespace fenestra
