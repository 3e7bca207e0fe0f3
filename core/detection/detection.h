#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace fenestra {

/// A window as a detector sees it. Frame C is the camera in which estimates are scored: the
/// unrectified left camera (stereo) or the camera that the depth image's pixels belong to (RGB-D).
/// Metres.
struct WindowEstimate {
  /// Centre of the window frame's front outer rectangle.
  Eigen::Vector3d p_CO = Eigen::Vector3d::Zero();
  /// Corners of that rectangle: top left, top right, bottom right, bottom left as seen in the
  /// image.
  std::array<Eigen::Vector3d, 4> p_CV = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                         Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  /// Unit normal of the window's plane, pointing towards the camera.
  Eigen::Vector3d normal_C = -Eigen::Vector3d::UnitZ();
  /// Covariance of p_CO [m²], where the detector can state one.
  std::optional<Eigen::Matrix3d> covariance_C{};
  /// Confidence from 0 to 1; comparable only between windows of one detector.
  std::optional<double> score{};
  /// Other candidates for a window, the best first, if the detector reports any.
  std::vector<WindowEstimate> others{};
};

/// No window found: an expected outcome, not an error.
struct Miss {
  std::string reason;  ///< A stable identifier in snake_case, such as "no_contour".
  std::string detail;  ///< For people: what was found and what would have been needed.
};

using Detection = std::variant<WindowEstimate, Miss>;

}  // namespace fenestra
