#include "core/geometry/pose.h"

#include "core/system/check.h"

namespace fenestra {

Pose::Pose(const Eigen::Matrix3d& R_AB, const Eigen::Vector3d& p_AB)
    : rotation_(R_AB), translation_(p_AB) {
  FENESTRA_CHECK(R_AB.allFinite() && p_AB.allFinite(), "a pose must be finite");
  const double deviation = (R_AB * R_AB.transpose() - Eigen::Matrix3d::Identity()).norm();
  FENESTRA_CHECK(deviation < 1e-9 && R_AB.determinant() > 0.0, "R_AB must be a rotation");
}

Pose Pose::Translation(const Eigen::Vector3d& p_AB) {
  return Pose(Eigen::Matrix3d::Identity(), p_AB);
}

Pose Pose::inverse() const {
  const Eigen::Matrix3d R_BA = rotation_.transpose();
  return Pose(R_BA, -(R_BA * translation_));
}

Pose Pose::operator*(const Pose& X_BC) const {
  return Pose(rotation_ * X_BC.rotation_, rotation_ * X_BC.translation_ + translation_);
}

Eigen::Matrix3d RotationFromVector(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
}

Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(),  //
      v.z(), 0.0, -v.x(),        //
      -v.y(), v.x(), 0.0;
  return matrix;
}

}  // namespace fenestra
