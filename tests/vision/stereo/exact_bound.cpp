#include "tests/vision/stereo/exact_bound.h"

#include <Eigen/LU>

namespace fenestra::testing {

ExactFrame Changed(const ExactFrame& frame, const ExactChange& by) {
  ExactFrame f = frame;
  f.X_LO = Pose(frame.X_LO.rotation() * RotationFromVector(by.segment<3>(3)),
                frame.X_LO.translation() + by.head<3>());
  f.width_m += by[6];
  f.height_m += by[7];
  f.border_m += by[8];
  f.wall_dn += by[9];
  f.frame_dn += by[10];
  f.opening_dn += by[11];
  f.blur_px += by[12];
  return f;
}

Eigen::VectorXd ExactPixels(const StereoCalibration& rig, const ExactFrame& frame) {
  const cv::Mat1f left = ExactPicture(rig.left, Pose(), frame);
  const cv::Mat1f right = ExactPicture(rig.right, rig.X_RL, frame);
  Eigen::VectorXd pixels(static_cast<Eigen::Index>(left.total() + right.total()));
  std::copy(right.begin(), right.end(), std::copy(left.begin(), left.end(), pixels.begin()));
  return pixels;
}

Eigen::Matrix<double, Eigen::Dynamic, kExactUnknowns> ExactJacobian(const StereoCalibration& rig,
                                                                    const ExactFrame& frame) {
  Eigen::Matrix<double, Eigen::Dynamic, kExactUnknowns> jacobian(ExactPixels(rig, frame).size(),
                                                                 kExactUnknowns);
  for (int i = 0; i < kExactUnknowns; ++i) {
    const double step = i < 9 ? 1e-3 : i < 12 ? 1.0 : 0.02;
    const ExactChange change = step * ExactChange::Unit(i);
    jacobian.col(i) =
        (ExactPixels(rig, Changed(frame, change)) - ExactPixels(rig, Changed(frame, -change))) /
        (2.0 * step);
  }
  return jacobian;
}

Eigen::Matrix3d ExactBound(const StereoCalibration& rig, const ExactFrame& frame, double variance) {
  const auto jacobian = ExactJacobian(rig, frame);
  const Eigen::Matrix<double, kExactUnknowns, kExactUnknowns> information =
      jacobian.transpose() * jacobian / variance;
  return information.inverse().topLeftCorner<3, 3>();
}

}  // namespace fenestra::testing
