#pragma once

#include <Eigen/Core>
#include <array>

namespace fenestra {

/// What four corners are as a rectangle.
struct WindowShape {
  double width_m = 0.0;   ///< Mean of the upper and the lower side.
  double height_m = 0.0;  ///< Mean of the left and the right side.
  /// Largest departure of a corner's angle from a right one [rad].
  double skew_rad = 0.0;
  /// Largest relative difference of opposite sides.
  double taper = 0.0;
};

/// Corners in the order of WindowEstimate.
WindowShape MeasureShape(const std::array<Eigen::Vector3d, 4>& p_CV);

}  // namespace fenestra
