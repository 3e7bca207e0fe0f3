#include "vision/stereo/paper/window_rectangle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

using Eigen::Vector3d;

// The point of diagonal V0 V2 that is nearest to diagonal V1 V3; in one plane they meet there.
Vector3d IntersectDiagonals(const std::array<Vector3d, 4>& V) {
  const Vector3d p = V[2] - V[0];
  const Vector3d q = V[3] - V[1];
  const Vector3d n = p.cross(q);
  const double s = (V[1] - V[0]).cross(q).dot(n) / n.squaredNorm();
  return V[0] + s * p;
}

}  // namespace

std::optional<WindowEstimate> WindowOnPlane(const Quadrilateral& corners_px,
                                            const DisparityPlane& plane,
                                            const RectifiedCamera& camera) {
  WindowEstimate estimate;
  for (size_t i = 0; i < 4; ++i) {
    const auto p_FV = plane.PointAt(corners_px[i], camera);
    if (!p_FV) return std::nullopt;
    estimate.p_CV[i] = *p_FV;
  }
  estimate.p_CO = IntersectDiagonals(estimate.p_CV);
  estimate.normal_C = plane.Normal(camera);
  if (!estimate.p_CO.allFinite()) return std::nullopt;
  return estimate;
}

WindowEstimate Rotated(const Eigen::Matrix3d& R_CF, const WindowEstimate& estimate_F) {
  WindowEstimate estimate = estimate_F;  // Score and all else that does not turn.
  estimate.p_CO = R_CF * estimate_F.p_CO;
  for (size_t i = 0; i < 4; ++i) estimate.p_CV[i] = R_CF * estimate_F.p_CV[i];
  estimate.normal_C = R_CF * estimate_F.normal_C;
  if (estimate_F.covariance_C) {
    estimate.covariance_C = R_CF * *estimate_F.covariance_C * R_CF.transpose();
  }
  return estimate;
}

}  // namespace fenestra
