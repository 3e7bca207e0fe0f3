#pragma once

#include <Eigen/Core>
#include <optional>

#include "vision/calibration/bundle_adjustment.h"

namespace fenestra {

/// What an estimate knows of a window frame and of its sensor before it sees any image.
struct PriorKnowledge {
  /// Standard deviation of width and height around what is expected [m]; nullopt: not expected.
  std::optional<double> size_sigma_m = {};
  /// Stereo: covariance of the nominal calibration's error; nullopt: it is the truth.
  std::optional<PairMatrix> calibration = {};
  /// RGB-D: standard deviation of how far the wall's face stands before the front of the frame,
  /// around what is expected [m]; nullopt: known.
  std::optional<double> wall_sigma_m = {};
};

/// Adds the prior on width and height to information whose first unknowns are a window frame's.
Eigen::MatrixXd WithSizePrior(const Eigen::MatrixXd& information, const PriorKnowledge& knowledge);

}  // namespace fenestra
