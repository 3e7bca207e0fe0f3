#pragma once

#include <Eigen/Core>

#include "core/geometry/calibration.h"
#include "tests/vision/frame/exact_frame.h"

namespace fenestra::testing {

/// Unknowns of a pair of exact pictures: place p_LO [m], turn in frame O [rad], width, height and
/// border [m], wall, frame and opening [DN], blur [px].
inline constexpr int kExactUnknowns = 13;
using ExactChange = Eigen::Matrix<double, kExactUnknowns, 1>;

ExactFrame Changed(const ExactFrame& frame, const ExactChange& by);

/// All pixels, the left picture's and then the right one's, row by row.
Eigen::VectorXd ExactPixels(const StereoCalibration& rig, const ExactFrame& frame);

/// Their derivatives by the unknowns: central differences of exact pictures.
Eigen::Matrix<double, Eigen::Dynamic, kExactUnknowns> ExactJacobian(const StereoCalibration& rig,
                                                                    const ExactFrame& frame);

/// Cramér and Rao's bound of the centroid's covariance for noise of this variance in each pixel
/// [DN²]: all pixels' information, nothing known beforehand but the calibration.
Eigen::Matrix3d ExactBound(const StereoCalibration& rig, const ExactFrame& frame, double variance);

}  // namespace fenestra::testing
