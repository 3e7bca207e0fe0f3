#pragma once

#include <Eigen/Core>

#include "core/geometry/pose.h"

namespace fenestra {

/// Motion of a rig while it takes an image: constant velocities of its frame B along and about its
/// own axes.
struct RigMotion {
  Eigen::Vector3d velocity_B = Eigen::Vector3d::Zero();          ///< [m/s]
  Eigen::Vector3d angular_velocity_B = Eigen::Vector3d::Zero();  ///< [rad/s]

  bool still() const { return velocity_B.isZero(0.0) && angular_velocity_B.isZero(0.0); }
};

/// X_WB at time t [s], given X_WB at time 0:  X_WB exp(t [ω; v]), a screw motion.
Pose PoseAt(const Pose& X_WB, const RigMotion& motion, double t_s);

/// Upper limit of an image's motion within t [px], for a camera of focal length f that sees nothing
/// nearer than nearest_m:  f t (|ω| (1 + r²) + |v| √(1 + r²)/nearest),  r: largest radius
/// of the image in normalised coordinates.
double ImageMotion(const RigMotion& motion, double t_s, double f_px, double radius,
                   double nearest_m);

}  // namespace fenestra
