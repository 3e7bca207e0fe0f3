#pragma once

#include <Eigen/Core>

#include "core/geometry/camera_model.h"
#include "core/random/random_stream.h"

namespace fenestra {

/// How a camera as built differs from its design: standard deviations of independent normal laws.
struct CameraDeviations {
  double focal_length = 0.0;        ///< Relative, the same for both axes.
  double principal_point_px = 0.0;  ///< Of each axis.
  double distortion = 0.0;          ///< Of each coefficient, relative.
};

/// The camera of this design that belongs to the stream.
CameraModel BuiltCamera(const CameraModel& design, const CameraDeviations& deviations,
                        const RandomStream& camera);

/// Covariance of the parameters of cameras of this design, in CameraModel::ParameterVector's order.
Eigen::Matrix<double, 9, 9> BuiltCovariance(const CameraModel& design,
                                            const CameraDeviations& deviations);

/// Covariance of a pose X that is moved to E X by a small displacement E with these standard
/// deviations (RandomPose): of its turn [rad], R = exp(δ) R₀, and of its translation [m]. E turns
/// X, and shifts it by turn x p besides the shift; p: X's translation.
Eigen::Matrix<double, 6, 6> MovedCovariance(const Eigen::Vector3d& p, double rotation_rad,
                                            double translation_m);

}  // namespace fenestra
