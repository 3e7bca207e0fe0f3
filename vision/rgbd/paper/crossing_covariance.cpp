#include "vision/rgbd/paper/crossing_covariance.h"

namespace fenestra {

Eigen::Matrix3d CrossingCovariance(const FourVertices& p_KV, const Plane& plane,
                                   const VertexErrors& errors) {
  const Eigen::Vector3d& n = plane.normal_K;
  const Eigen::Matrix3d across = n * n.transpose();
  const Eigen::Matrix3d along = Eigen::Matrix3d::Identity() - across;
  const double unequal_m = (p_KV[2] - p_KV[0]).norm() - (p_KV[3] - p_KV[1]).norm();
  const double squares_m2 =
      (along * (p_KV[0] - p_KV[1] + p_KV[2] - p_KV[3])).squaredNorm() + unequal_m * unequal_m;
  const double variance_m2 =
      (errors.expected_weight * errors.expected_m * errors.expected_m + 0.25 * squares_m2) /
      (errors.expected_weight + 3.0);
  return 0.5 * variance_m2 * along +
         (0.25 * errors.across_m * errors.across_m + errors.common_m * errors.common_m) * across;
}

}  // namespace fenestra
