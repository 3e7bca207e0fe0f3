#include "vision/stereo/paper/window_rectangle.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// The point of diagonal V0 V2 nearest to diagonal V1 V3, i.e. their intersection if they are
// coplanar.
Vector3d IntersectDiagonals(const std::array<Vector3d, 4>& V) {
  const Vector3d p = V[2] - V[0];
  const Vector3d q = V[3] - V[1];
  const Vector3d n = p.cross(q);
  const double s = (V[1] - V[0]).cross(q).dot(n) / n.squaredNorm();
  return V[0] + s * p;
}

bool IsOn(const DisparityPlane& plane, const DisparitySample& s, double tolerance_px) {
  return std::abs(plane.Residual(s)) <= tolerance_px;
}

// Pixels are relative to the requested one, whose own row is therefore (0, 0, 1).
Vector3d Row(const DisparitySample& s, const Eigen::Vector2d& pixel) {
  return {s.u_px - pixel.x(), s.v_px - pixel.y(), 1.0};
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
  WindowEstimate estimate =
      estimate_F;  // Copies the score and everything else that does not rotate.
  estimate.p_CO = R_CF * estimate_F.p_CO;
  for (size_t i = 0; i < 4; ++i) estimate.p_CV[i] = R_CF * estimate_F.p_CV[i];
  estimate.normal_C = R_CF * estimate_F.normal_C;
  if (estimate_F.covariance_C) {
    estimate.covariance_C = R_CF * *estimate_F.covariance_C * R_CF.transpose();
  }
  return estimate;
}

std::optional<double> DisparityVariance(const std::vector<const MatchedPatch*>& patches,
                                        const DisparityPlane& plane, double tolerance_px,
                                        const Eigen::Vector2d& pixel, const MatchErrors& errors) {
  Matrix3d A = Matrix3d::Zero();
  double squares_px2 = 0.0;
  double windows = 0.0;
  int count = 0;
  for (const MatchedPatch* patch : patches) {
    windows += std::max(1.0, patch->area_px / (errors.window_px * errors.window_px));
    for (const DisparitySample& s : patch->samples) {
      if (!IsOn(plane, s, tolerance_px)) continue;
      const Vector3d row = Row(s, pixel);
      A += row * row.transpose();
      squares_px2 += plane.Residual(s) * plane.Residual(s);
      ++count;
    }
  }
  if (count < 4) return std::nullopt;
  const Eigen::LDLT<Matrix3d> solver(A);
  const Vector3d D = solver.vectorD();
  if (!(D.minCoeff() > 1e-9 * D.maxCoeff())) return std::nullopt;
  const Vector3d k = solver.solve(Vector3d::UnitZ());
  double weights2 = 0.0;
  double bias2 = 0.0;
  for (const MatchedPatch* patch : patches) {
    double patch_weight = 0.0;
    for (const DisparitySample& s : patch->samples) {
      if (!IsOn(plane, s, tolerance_px)) continue;
      const double weight = Row(s, pixel).dot(k);
      weights2 += weight * weight;
      patch_weight += weight;
    }
    bias2 += patch_weight * patch_weight;
  }
  const double alike = std::max(1.0, count / windows);
  return squares_px2 / (count - 3) * weights2 * alike +
         errors.subpixel_bias_px * errors.subpixel_bias_px * bias2;
}

Matrix3d CentreCovariance(const Eigen::Vector2d& pixel, const DisparityPlane& plane,
                          double disparity_variance_px2, const RectifiedCamera& camera,
                          const MatchErrors& errors) {
  const double d = plane.At(pixel);
  const double z = camera.DepthFromDisparity(d);
  const Vector3d ray = camera.Ray(pixel);
  Matrix3d by_uvd;  // Columns: derivatives by u, v and the plane's disparity.
  by_uvd.col(2) = -z / d * ray;
  by_uvd.col(0) = z / camera.f_px * Vector3d::UnitX() + plane.a * by_uvd.col(2);
  by_uvd.col(1) = z / camera.f_px * Vector3d::UnitY() + plane.b * by_uvd.col(2);
  const double centre_px2 = 0.5 * errors.contour_px * errors.contour_px;
  const Vector3d variances(centre_px2, centre_px2, disparity_variance_px2);
  return by_uvd * variances.asDiagonal() * by_uvd.transpose();
}

}  // namespace fenestra
