#include "sim/motion/rig_pose.h"

#include <Eigen/Geometry>
#include <cmath>

namespace fenestra {
namespace {

Eigen::Matrix3d Cross(const Eigen::Vector3d& a) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return matrix;
}

// The mean of the rotations by s θ, 0 ≤ s ≤ 1, which turns a velocity in a turning frame into a
// displacement. The left Jacobian of SO(3).
Eigen::Matrix3d MeanRotation(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  const Eigen::Matrix3d K = Cross(rotation_vector);
  const double angle2 = angle * angle;
  // The series replaces the closed form where that would divide by a small number.
  const bool small = angle < 1e-4;
  const double a = small ? 0.5 - angle2 / 24.0 : (1.0 - std::cos(angle)) / angle2;
  const double b =
      small ? 1.0 / 6.0 - angle2 / 120.0 : (angle - std::sin(angle)) / (angle2 * angle);
  return Eigen::Matrix3d::Identity() + a * K + b * K * K;
}

}  // namespace

Pose RigPose(const Viewpoint& viewpoint, const Pose& X_WO) {
  using Eigen::AngleAxisd;
  using Eigen::Matrix3d;
  using Eigen::Vector3d;

  const Vector3d outward_O(std::sin(viewpoint.azimuth_rad) * std::cos(viewpoint.elevation_rad),
                           std::sin(viewpoint.elevation_rad),
                           std::cos(viewpoint.azimuth_rad) * std::cos(viewpoint.elevation_rad));
  // With a level horizon "right" does not depend on the elevation, so that looking straight up or
  // down is no special case.
  const Vector3d right_O(std::cos(viewpoint.azimuth_rad), 0.0, -std::sin(viewpoint.azimuth_rad));
  const Vector3d forward_O = -outward_O;
  Matrix3d R_OA;  // A: the rig when it looks straight at the centroid.
  R_OA << right_O, forward_O.cross(right_O), forward_O;

  const Matrix3d R_AB = (AngleAxisd(viewpoint.yaw_rad, Vector3d::UnitY()) *
                         AngleAxisd(viewpoint.pitch_rad, Vector3d::UnitX()) *
                         AngleAxisd(viewpoint.roll_rad, Vector3d::UnitZ()))
                            .toRotationMatrix();
  return X_WO * Pose(R_OA * R_AB, viewpoint.distance_m * outward_O);
}

RigMotion WithHover(const RigMotion& motion, const HoverOptions& hover, const RandomStream& image) {
  const auto three_normals = [](const RandomStream& stream) {
    return Eigen::Vector3d(stream.Normal(0), stream.Normal(1), stream.Normal(2));
  };
  return {.velocity_B = motion.velocity_B + hover.speed_m_s * three_normals(image.Child("speed")),
          .angular_velocity_B =
              motion.angular_velocity_B + hover.turn_rad_s * three_normals(image.Child("turn"))};
}

Pose PoseAt(const Pose& X_WB, const RigMotion& motion, double t_s) {
  if (motion.still() || t_s == 0.0) return X_WB;
  const Eigen::Vector3d rotation = motion.angular_velocity_B * t_s;
  const Eigen::Vector3d translation = MeanRotation(rotation) * (motion.velocity_B * t_s);
  return X_WB * Pose(RotationFromVector(rotation), translation);
}

double ImageMotion(const RigMotion& motion, double t_s, double f_px, double radius,
                   double nearest_m) {
  const double stretch = 1.0 + radius * radius;
  return f_px * std::abs(t_s) *
         (motion.angular_velocity_B.norm() * stretch +
          motion.velocity_B.norm() * std::sqrt(stretch) / nearest_m);
}

}  // namespace fenestra
