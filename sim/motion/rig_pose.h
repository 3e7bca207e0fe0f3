#pragma once

#include <Eigen/Core>

#include "core/geometry/pose.h"
#include "core/random/random_stream.h"

namespace fenestra {

/// Position and direction of a sensor rig relative to a window. The rig's frame B has a camera's
/// axes: +x right, +y down, +z forward.
struct Viewpoint {
  double distance_m = 2.0;  ///< Distance from the window's centroid to the rig's origin.
  /// The rig sits on the sphere around the centroid: at zero, straight in front of the window.
  double azimuth_rad = 0.0;    ///< Towards the window's +x (the viewer's right).
  double elevation_rad = 0.0;  ///< Upwards.
  /// Rotations from looking straight at the centroid with a level horizon, in this order and each
  /// about the rig's own axes: yaw about +y (to the right), pitch about +x (up), roll about +z
  /// (clockwise as the camera's user sees it).
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;
  double roll_rad = 0.0;
};

/// X_WB of the rig that looks at the window whose frame is X_WO.
Pose RigPose(const Viewpoint& viewpoint, const Pose& X_WO);

/// Motion of a rig while it takes an image: constant velocities of its frame B along and about its
/// own axes.
struct RigMotion {
  Eigen::Vector3d velocity_B = Eigen::Vector3d::Zero();          ///< [m/s]
  Eigen::Vector3d angular_velocity_B = Eigen::Vector3d::Zero();  ///< [rad/s]

  bool still() const { return velocity_B.isZero(0.0) && angular_velocity_B.isZero(0.0); }
};

/// How a vehicle moves that holds its place: standard deviations of independent normal laws of its
/// velocities along and about each axis, new in each image. Assumed: some centimetres and degrees
/// per second are usual for multirotors indoors and in light wind.
struct HoverOptions {
  double speed_m_s = 0.05;
  double turn_rad_s = 0.05;
};

/// A motion with that of hovering added, as drawn from the stream.
RigMotion WithHover(const RigMotion& motion, const HoverOptions& hover, const RandomStream& image);

/// X_WB at time t [s], given X_WB at time 0:  X_WB exp(t [ω; v]), a screw motion.
Pose PoseAt(const Pose& X_WB, const RigMotion& motion, double t_s);

/// Upper limit of an image's motion within t [px], for a camera of focal length f that sees nothing
/// nearer than nearest_m:  f t (|ω| (1 + r²) + |v| √(1 + r²)/nearest),  r: largest radius
/// of the image in normalised coordinates.
double ImageMotion(const RigMotion& motion, double t_s, double f_px, double radius,
                   double nearest_m);

}  // namespace fenestra
