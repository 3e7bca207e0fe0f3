#include "sim/camera/built_camera.h"

#include "core/geometry/pose.h"

namespace fenestra {

CameraModel BuiltCamera(const CameraModel& design, const CameraDeviations& deviations,
                        const RandomStream& camera) {
  CameraParameters built = design.parameters();
  const double focal = 1.0 + deviations.focal_length * camera.Child("focal_length").Normal(0);
  built.fx_px *= focal;
  built.fy_px *= focal;
  const RandomStream principal_point = camera.Child("principal_point");
  built.cx_px += deviations.principal_point_px * principal_point.Normal(0);
  built.cy_px += deviations.principal_point_px * principal_point.Normal(1);
  const RandomStream distortion = camera.Child("distortion");
  BrownConrady& d = built.distortion;
  uint64_t index = 0;
  for (double* coefficient : {&d.k1, &d.k2, &d.p1, &d.p2, &d.k3}) {
    *coefficient *= 1.0 + deviations.distortion * distortion.Normal(index++);
  }
  return CameraModel(built);
}

Eigen::Matrix<double, 9, 9> BuiltCovariance(const CameraModel& design,
                                            const CameraDeviations& deviations) {
  const Eigen::Matrix<double, 9, 1> parameters = design.ParameterVector();
  Eigen::Matrix<double, 9, 9> covariance = Eigen::Matrix<double, 9, 9>::Zero();
  // One factor for both focal lengths.
  covariance.topLeftCorner<2, 2>() = deviations.focal_length * deviations.focal_length *
                                     parameters.head<2>() * parameters.head<2>().transpose();
  covariance.diagonal().segment<2>(2).setConstant(deviations.principal_point_px *
                                                  deviations.principal_point_px);
  covariance.diagonal().tail<5>() = (deviations.distortion * parameters.tail<5>()).cwiseAbs2();
  return covariance;
}

Eigen::Matrix<double, 6, 6> MovedCovariance(const Eigen::Vector3d& p, double rotation_rad,
                                            double translation_m) {
  const Eigen::Matrix3d by_turn = -CrossMatrix(p);
  const double turn2 = rotation_rad * rotation_rad;
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  covariance.topLeftCorner<3, 3>().diagonal().setConstant(turn2);
  covariance.bottomLeftCorner<3, 3>() = turn2 * by_turn;
  covariance.topRightCorner<3, 3>() = turn2 * by_turn.transpose();
  covariance.bottomRightCorner<3, 3>() =
      turn2 * by_turn * by_turn.transpose() +
      translation_m * translation_m * Eigen::Matrix3d::Identity();
  return covariance;
}

}  // namespace fenestra
