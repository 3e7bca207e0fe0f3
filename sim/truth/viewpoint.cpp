#include "sim/truth/viewpoint.h"

#include <cmath>

namespace fenestra {

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

}  // namespace fenestra
