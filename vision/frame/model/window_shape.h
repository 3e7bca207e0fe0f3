#pragma once

#include <Eigen/Core>
#include <array>

namespace fenestra {

/// How nearly four corners form a rectangle.
struct WindowShape {
  double width_m = 0.0;   ///< Mean of the upper and the lower side.
  double height_m = 0.0;  ///< Mean of the left and the right side.
  /// Largest departure of a corner from a right angle [rad].
  double skew_rad = 0.0;
  /// Largest relative difference of opposite sides.
  double taper = 0.0;
};

/// Measures the shape of four corners, given in the order of WindowEstimate.
WindowShape MeasureShape(const std::array<Eigen::Vector3d, 4>& p_CV);

}  // namespace fenestra
