#include "vision/rgbd/paper/depth_registration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/io/input_error.h"
#include "core/random/random_stream.h"
#include "tests/vision/rgbd/synthetic_kinect.h"

namespace fenestra {
namespace {

using testing::KinectCalibration;
using testing::RegisteredCalibration;

RgbdObservation RandomObservation(const RgbdCalibration& calibration) {
  const RandomStream random(3);
  RgbdObservation observation;
  observation.depth.unit_m = calibration.depth_unit_m;
  observation.color.create(calibration.color.height_px(), calibration.color.width_px());
  observation.depth.raw.create(calibration.depth.height_px(), calibration.depth.width_px());
  uint64_t index = 0;
  for (cv::Vec3b& pixel : observation.color) {
    for (int c = 0; c < 3; ++c) pixel[c] = static_cast<uchar>(256.0 * random.Uniform(index++));
  }
  for (ushort& raw : observation.depth.raw) {
    raw = static_cast<ushort>(65536.0 * random.Uniform(index++));
  }
  return observation;
}

TEST(WorkingCamera, OfAKinectIsTheColourCameraAtHalfTheResolution) {
  const RgbdCalibration kinect = KinectCalibration();
  EXPECT_EQ(WorkingCamera(kinect), kinect.color.Scaled(0.5));
  EXPECT_EQ(WorkingCamera(RegisteredCalibration()), RegisteredCalibration().color);
}

TEST(WorkingCamera, IsNeverFinerThanTheDepthPixelsOrTheColourImage) {
  RgbdCalibration calibration = KinectCalibration();
  calibration.depth = CameraModel::Pinhole(320, 240, 200.0);  // Wider field: coarser pixels.
  EXPECT_LE(WorkingCamera(calibration).parameters().fx_px, 200.5);
  calibration.depth = CameraModel::Pinhole(1280, 960, 2000.0);
  EXPECT_EQ(WorkingCamera(calibration).width_px(), 640);
}

TEST(DepthRegistration, OfRegisteredDepthIsTheIdentity) {
  const RgbdCalibration calibration = RegisteredCalibration();
  const RgbdObservation observation = RandomObservation(calibration);
  const RegisteredImages images = DepthRegistration(calibration).Register(observation);
  EXPECT_EQ(cv::norm(images.color, observation.color, cv::NORM_INF), 0.0);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      // One product in single precision.
      ASSERT_FLOAT_EQ(images.depth_m(v, u),
                      0.001f * static_cast<float>(observation.depth.raw(v, u)));
    }
  }
}

TEST(DepthRegistration, CarriesAPlaneToItsDepthInTheColourCamera) {
  RgbdCalibration calibration = KinectCalibration();
  calibration.X_KD = Pose(RotationFromVector({0.01, -0.02, 0.03}), {-0.025, 0.003, 0.005});
  calibration.depth_unit_m = 1e-4;
  const Pose X_DO = testing::PoseOfWindow({.distance_m = 1.5, .azimuth_rad = 0.3});
  RgbdObservation observation = RandomObservation(calibration);
  const cv::Mat1f seen_m = testing::PlaneDepth(calibration.depth, X_DO);
  seen_m.convertTo(observation.depth.raw, CV_16U, 1.0 / calibration.depth_unit_m);

  const DepthRegistration registration(calibration);
  const cv::Mat1f depth_m = registration.Register(observation).depth_m;
  const CameraModel& working = registration.working_camera();
  const cv::Mat1f expected_m = testing::PlaneDepth(working, calibration.X_KD * X_DO);
  int holes = 0;
  for (int v = 20; v < 220; ++v) {
    for (int u = 20; u < 300; ++u) {
      if (depth_m(v, u) == 0.0f) {
        ++holes;
        continue;
      }
      // A point lies up to half a pixel from the centre of the pixel that it is rounded to, in
      // either direction; the plane's depth there differs by its slope, which its neighbours show.
      // Half a unit of the depth image comes on top.
      const double slope_u = 0.5 * std::abs(expected_m(v, u + 1) - expected_m(v, u - 1));
      const double slope_v = 0.5 * std::abs(expected_m(v + 1, u) - expected_m(v - 1, u));
      const double bound_m = 0.5 * 1.01 * (slope_u + slope_v) + 0.6 * calibration.depth_unit_m;
      ASSERT_NEAR(depth_m(v, u), expected_m(v, u), bound_m) << u << ' ' << v;
    }
  }
  // The grids are rolled by 0.03 rad against each other, which leaves about 0.8 % empty.
  EXPECT_LT(holes, 0.016 * 280 * 200);
}

TEST(DepthRegistration, OfParallelCamerasLeavesNoHoles) {
  const RgbdCalibration calibration = KinectCalibration();
  RgbdObservation observation = RandomObservation(calibration);
  observation.depth.raw = 2000;
  const cv::Mat1f depth_m = DepthRegistration(calibration).Register(observation).depth_m;
  // Far enough from the borders, where the colour camera sees what the depth camera does not.
  const cv::Mat1f seen = depth_m(cv::Rect(20, 20, 280, 200));
  EXPECT_EQ(cv::countNonZero(seen == 2.0f), 280 * 200);
}

TEST(DepthRegistration, KeepsTheNearestOfSeveralPoints) {
  RgbdCalibration calibration = RegisteredCalibration();
  calibration.color = CameraModel::Pinhole(2, 2, 10.0);
  calibration.depth = CameraModel::Pinhole(8, 8, 40.0);  // 4 x 4 depth pixels per colour pixel.
  RgbdObservation observation = RandomObservation(calibration);
  const cv::Mat1f depth_m = DepthRegistration(calibration).Register(observation).depth_m;
  for (int v = 0; v < 2; ++v) {
    for (int u = 0; u < 2; ++u) {
      double nearest = 0.0;
      cv::minMaxLoc(observation.depth.raw(cv::Rect(4 * u, 4 * v, 4, 4)), &nearest);
      EXPECT_FLOAT_EQ(depth_m(v, u), static_cast<float>(nearest * 0.001));
    }
  }
}

TEST(DepthRegistration, AveragesColourOverTheWorkingPixel) {
  const RgbdCalibration calibration = KinectCalibration();
  const RgbdObservation observation = RandomObservation(calibration);
  const cv::Mat3b color = DepthRegistration(calibration).Register(observation).color;
  ASSERT_EQ(color.size(), cv::Size(320, 240));
  for (int v = 0; v < 240; v += 17) {
    for (int u = 0; u < 320; u += 13) {
      const cv::Scalar mean = cv::mean(observation.color(cv::Rect(2 * u, 2 * v, 2, 2)));
      // Rounding to integers.
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(color(v, u)[c], mean[c], 0.5 + 1e-9);
    }
  }
}

TEST(DepthRegistration, FreesColourOfDistortion) {
  RgbdCalibration calibration = KinectCalibration();
  CameraParameters parameters = calibration.color.parameters();
  parameters.distortion = {.k1 = -0.2, .k2 = 0.05, .p1 = 1e-3, .p2 = -5e-4, .k3 = 0.0};
  calibration.color = CameraModel(parameters);
  RgbdObservation observation = RandomObservation(calibration);
  // Grey values tell the direction of the ray.
  const auto grey = [](const Eigen::Vector3d& ray) { return 128.0 + 80.0 * (ray.x() + ray.y()); };
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const double value = grey(*calibration.color.UnprojectRay({u, v}));
      observation.color(v, u) = cv::Vec3b::all(static_cast<uchar>(std::lround(value)));
    }
  }
  const DepthRegistration registration(calibration);
  const cv::Mat3b color = registration.Register(observation).color;
  for (int v = 10; v < 230; v += 5) {
    for (int u = 10; u < 310; u += 5) {
      // Three roundings: of the image, of the interpolation and of the average.
      EXPECT_NEAR(color(v, u)[0], grey(*registration.working_camera().UnprojectRay({u, v})), 1.5);
    }
  }
}

TEST(DepthRegistration, WhatTheLensDoesNotSeeIsNotDark) {
  // A lens whose corners see less than a pinhole's would.
  CameraParameters parameters = KinectCalibration().color.parameters();
  parameters.distortion = {.k1 = 0.3};
  RgbdCalibration calibration = KinectCalibration();
  calibration.color = CameraModel(parameters);
  const cv::Mat3b grey(parameters.height_px, parameters.width_px, cv::Vec3b(90, 90, 90));
  const DepthImage depth{.raw = cv::Mat1w(calibration.depth.height_px(),
                                          calibration.depth.width_px(), uint16_t{2000})};
  const RegisteredImages images = DepthRegistration(calibration).Register({grey, depth});
  EXPECT_EQ(
      cv::norm(images.color, cv::Mat3b(images.color.size(), cv::Vec3b(90, 90, 90)), cv::NORM_INF),
      0.0);
}

TEST(DepthRegistration, RefusesImagesThatDoNotFitTheCalibration) {
  const RgbdCalibration calibration = KinectCalibration();
  const DepthRegistration registration(calibration);
  RgbdObservation observation = RandomObservation(calibration);
  observation.depth.raw = observation.depth.raw.rowRange(0, 100).clone();
  observation.depth.unit_m = 0.0002;
  try {
    registration.Register(observation);
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 2u) << error.what();
  }
  EXPECT_THROW(registration.Register(RgbdObservation{}), InputError);
}

}  // namespace
}  // namespace fenestra
