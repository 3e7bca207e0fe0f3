#pragma once

#include <filesystem>
#include <string>
#include <variant>

#include "core/geometry/camera_model.h"
#include "core/geometry/pose.h"

namespace fenestra {

/// Calibration of a stereo rig, as a robot has it. Frames: L left camera, R right camera.
struct StereoCalibration {
  CameraModel left;
  CameraModel right;
  Pose X_RL;  ///< p_RQ = X_RL * p_LQ; the R and T of OpenCV's stereoCalibrate.

  bool operator==(const StereoCalibration&) const = default;
};

/// Calibration of an RGB-D sensor, as a robot has it. Frames: K colour camera, D the camera whose
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

/// Calibration files. Numbers are written in the shortest form that reads back to the same double,
/// so that a calibration survives the way through a file without a changed bit.
///
/// Format: the YAML of OpenCV's FileStorage, with the names that OpenCV's stereo samples use:
///
///   stereo:  image_width, image_height, K1, D1, K2, D2, R, T
///            (1 left, 2 right; p_R = R p_L + T, metres; D = k1 k2 p1 p2 k3)
///   rgbd:    color_width, color_height, K_color, D_color,
///            depth_width, depth_height, K_depth, D_depth, R, T, depth_unit_m
///            (p_K = R p_D + T, metres; for a depth image registered to colour R = 1, T = 0;
///            without depth_unit_m it is 0.001)
///
/// A matrix may also be a plain list of its numbers, row by row, or a list of rows. Readers throw
/// InputError with all faults of the file and their positions; also for what is implausible: a
/// field of view above 170 degrees, cameras more than 10 m apart (2 m from depth to colour), a
/// depth unit that DepthUnitObjection refuses, and statements that contradict how the file is read
/// (calibration_entries.h).

StereoCalibration ReadStereoCalibration(const std::filesystem::path& file);
RgbdCalibration ReadRgbdCalibration(const std::filesystem::path& file);

std::string ToOpenCvYaml(const StereoCalibration& calibration);
std::string ToOpenCvYaml(const RgbdCalibration& calibration);

/// How a camera's image is rectified: R turns its rays, P projects them afterwards. The right
/// camera of a pair has P(0, 3) = -fx B.
struct RosRectification {
  Eigen::Matrix3d rotation;
  Eigen::Matrix<double, 3, 4> projection;
};

/// ROS `camera_info` (sensor_msgs/CameraInfo as camera_calibration_parsers writes it). A camera of
/// its own has R = 1 and P = [K | 0]. Readable again with ReadCameraInfo.
std::string ToRosCameraInfo(const CameraModel& camera, const std::string& camera_name);
std::string ToRosCameraInfo(const CameraModel& camera, const std::string& camera_name,
                            const RosRectification& rectification);
CameraModel ReadCameraInfo(const std::filesystem::path& file);

}  // namespace fenestra
