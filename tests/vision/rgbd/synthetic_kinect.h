#pragma once

#include <optional>

#include "core/detection/observation.h"
#include "core/geometry/calibration.h"
#include "core/random/random_stream.h"
#include "tests/support/planar_target.h"

namespace fenestra::testing {

/// A Kinect without a renderer: the nominal cameras of the structured-light sensor, looking at a
/// square frame painted on an endless wall.
struct SyntheticKinect {
  PlanarTarget target;
  Pose X_DO;
  int frame_dn = 31;
  int wall_dn = 128;
};

/// Depth 320 x 240 px at 285.63 px, colour 640 x 480 px at 531.15 px, K 2.5 cm right of D.
RgbdCalibration KinectCalibration();

/// Depth already seen by the colour camera: 640 x 480 px at 525 px for both.
RgbdCalibration RegisteredCalibration();

/// Colour without noise. Depth without noise is rounded to millimetres only; with `noise`, the
/// disparity  d = f b / z  (f b = 42.84 px m in the 640-wide image) is disturbed by a normal
/// variate of 0.05 px, rounded to 1/8 px, and its depth is rounded to millimetres.
RgbdObservation Observe(const RgbdCalibration& calibration, const SyntheticKinect& scene,
                        const std::optional<RandomStream>& noise);

/// Where a camera may stand and look: facing the window from `distance_m`, carried about the
/// window's vertical axis by the azimuth, then yawed about its own vertical and rolled about its
/// own optical axis.
struct Look {
  double distance_m = 1.0;
  double azimuth_rad = 0.0;
  double yaw_rad = 0.0;
  double roll_rad = 0.0;
};

Pose PoseOfWindow(const Look& look);

}  // namespace fenestra::testing
