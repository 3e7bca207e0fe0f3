#include "vision/rgbd/paper/diagonals.h"

namespace fenestra {
namespace {

// sin² of the smallest angle between diagonals that are not called parallel.
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

}  // namespace fenestra
