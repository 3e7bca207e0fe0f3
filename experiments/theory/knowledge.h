#pragma once

#include <Eigen/Core>
#include <optional>

#include "vision/calibration/bundle_adjustment.h"

namespace fenestra {

/// What an estimate knows of a window frame besides its images.
struct Knowledge {
  /// Standard deviation of width and height around what is expected [m]; nullopt: not expected.
  std::optional<double> size_sigma_m = {};
  /// Stereo: how far the calibration that it is told may be from the truth; nullopt: it is the
  /// truth.
  std::optional<PairMatrix> calibration = {};
  /// RGB-D: standard deviation of how far the wall's face stands before the front of the frame,
  /// around what is expected [m]; nullopt: known.
  std::optional<double> wall_sigma_m = {};
};

/// Information whose first unknowns are those of a frame, with what is known of its size.
Eigen::MatrixXd WithSizePrior(const Eigen::MatrixXd& information, const Knowledge& knowledge);

}  // namespace fenestra
