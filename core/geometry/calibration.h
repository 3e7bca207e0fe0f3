#pragma once

#include <variant>

#include "core/geometry/camera_model.h"
#include "core/geometry/pose.h"

namespace fenestra {

/// What a robot believes about its stereo rig. Frames: L left camera, R right camera.
struct StereoCalibration {
  CameraModel left;
  CameraModel right;
  Pose X_RL;  ///< p_RQ = X_RL * p_LQ; the R and T of OpenCV's stereoCalibrate.

  bool operator==(const StereoCalibration&) const = default;
};

/// What a robot believes about its RGB-D sensor. Frames: K colour camera, D the camera whose
/// pixels the depth image has. For a depth image that is registered to the colour image, D is K:
/// X_KD is the identity and both cameras are the same.
struct RgbdCalibration {
  CameraModel color;
  CameraModel depth;
  Pose X_KD;
  double depth_unit_m = 0.001;  ///< Metres per unit of the 16-bit depth image.

  bool operator==(const RgbdCalibration&) const = default;
};

using SensorCalibration = std::variant<StereoCalibration, RgbdCalibration>;

}  // namespace fenestra
