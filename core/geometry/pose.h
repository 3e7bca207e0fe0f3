#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <numbers>

namespace fenestra {

/// One degree [rad].
inline constexpr double kDegree = std::numbers::pi / 180.0;

/// A rigid transform X_AB that maps coordinates in frame B to coordinates in frame A:
///
///     p_AQ = X_AB * p_BQ = R_AB p_BQ + p_AB
///
/// where p_AB is the origin of B expressed in A. Immutable. Adjacent frame letters must match in
/// every product: X_AC = X_AB * X_BC. Metres.
class Pose {
 public:
  /// The identity.
  Pose() = default;

  /// Throws std::logic_error unless R_AB is a rotation to 1e-9 and all numbers are finite.
  Pose(const Eigen::Matrix3d& R_AB, const Eigen::Vector3d& p_AB);

  /// A pure translation.
  static Pose Translation(const Eigen::Vector3d& p_AB);

  const Eigen::Matrix3d& rotation() const { return rotation_; }
  const Eigen::Vector3d& translation() const { return translation_; }

  /// X_BA.
  Pose inverse() const;

  Pose operator*(const Pose& X_BC) const;
  Eigen::Vector3d operator*(const Eigen::Vector3d& p_BQ) const {
    return rotation_ * p_BQ + translation_;
  }

  bool operator==(const Pose& other) const {
    return rotation_ == other.rotation_ && translation_ == other.translation_;
  }

 private:
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation_ = Eigen::Vector3d::Zero();
};

/// The rotation by |rotation_vector| radians about rotation_vector (Rodrigues).
Eigen::Matrix3d RotationFromVector(const Eigen::Vector3d& rotation_vector);

/// [v]×, the matrix with [v]× w = v × w.
Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v);

}  // namespace fenestra
