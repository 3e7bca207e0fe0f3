#include "vision/rgbd/paper/diagonals.h"

namespace fenestra {
namespace {

// sin² of the smallest angle between diagonals that do not count as parallel.
constexpr double kSmallestSine2 = 1e-12;

bool IsInside(double parameter) {
  return parameter > 0.0 && parameter < 1.0;
}

}  // namespace

std::optional<DiagonalCrossing> CrossDiagonals(const FourVertices& p_CV) {
  const Eigen::Vector3d u = p_CV[2] - p_CV[0];
  const Eigen::Vector3d v = p_CV[3] - p_CV[1];
  const Eigen::Vector3d w = p_CV[0] - p_CV[1];
  const double uu = u.squaredNorm();
  const double vv = v.squaredNorm();
  const double uv = u.dot(v);
  const double determinant = uu * vv - uv * uv;
  if (!(determinant > kSmallestSine2 * uu * vv)) return std::nullopt;
  const double s = (uv * v.dot(w) - vv * u.dot(w)) / determinant;
  const double t = (uu * v.dot(w) - uv * u.dot(w)) / determinant;
  if (!IsInside(s) || !IsInside(t)) return std::nullopt;
  const Eigen::Vector3d p_CA = p_CV[0] + s * u;
  const Eigen::Vector3d p_CB = p_CV[1] + t * v;
  return DiagonalCrossing{.p_CO = 0.5 * (p_CA + p_CB), .gap_m = (p_CA - p_CB).norm()};
}

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
