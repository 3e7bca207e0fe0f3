#include "vision/stereo/window_rectangle.h"

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

double RelativeDifference(double a, double b) {
  return std::abs(a - b) / (0.5 * (a + b));
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
  WindowEstimate estimate;
  estimate.p_CO = R_CF * estimate_F.p_CO;
  for (size_t i = 0; i < 4; ++i) estimate.p_CV[i] = R_CF * estimate_F.p_CV[i];
  estimate.normal_C = R_CF * estimate_F.normal_C;
  if (estimate_F.covariance_C) {
    estimate.covariance_C = R_CF * *estimate_F.covariance_C * R_CF.transpose();
  }
  return estimate;
}

WindowShape MeasureShape(const WindowEstimate& estimate) {
  std::array<Vector3d, 4> side;
  for (size_t i = 0; i < 4; ++i) side[i] = estimate.p_CV[(i + 1) % 4] - estimate.p_CV[i];
  WindowShape shape;
  shape.width_m = 0.5 * (side[0].norm() + side[2].norm());
  shape.height_m = 0.5 * (side[1].norm() + side[3].norm());
  shape.taper = std::max(RelativeDifference(side[0].norm(), side[2].norm()),
                         RelativeDifference(side[1].norm(), side[3].norm()));
  for (size_t i = 0; i < 4; ++i) {
    const Vector3d& next = side[(i + 1) % 4];
    const double sine = std::abs(side[i].normalized().dot(next.normalized()));
    shape.skew_rad = std::max(shape.skew_rad, std::asin(std::min(1.0, sine)));
  }
  return shape;
}

}  // namespace fenestra
