#include "core/geometry/camera_model.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

#include "core/io/faults.h"

namespace fenestra {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// tan 80°: no calibration of a Brown–Conrady lens reaches farther.
constexpr double kLargestRadius = 5.671281819617709;
// The radial polynomial must still grow with at least this slope, so that its inverse is stable.
constexpr double kSmallestSlope = 0.01;

double RadialSlope(const BrownConrady& d, double r) {
  const double r2 = r * r;
  return 1.0 + r2 * (3.0 * d.k1 + r2 * (5.0 * d.k2 + r2 * 7.0 * d.k3));
}

double LargestMonotonicRadius(const BrownConrady& d) {
  if (d.k1 == 0.0 && d.k2 == 0.0 && d.k3 == 0.0) return kLargestRadius;
  // The slope is a polynomial in r; march until it falls below the limit, then bisect.
  constexpr double kStep = 1.0 / 256.0;
  double inside = 0.0;
  while (inside < kLargestRadius && RadialSlope(d, inside + kStep) >= kSmallestSlope) {
    inside += kStep;
  }
  if (inside >= kLargestRadius) return kLargestRadius;
  double outside = inside + kStep;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (inside + outside);
    (RadialSlope(d, middle) >= kSmallestSlope ? inside : outside) = middle;
  }
  return inside;
}

Vector2d Distort(const BrownConrady& d, const Vector2d& n) {
  const double x = n.x();
  const double y = n.y();
  const double r2 = x * x + y * y;
  const double g = 1.0 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  return {x * g + 2.0 * d.p1 * x * y + d.p2 * (r2 + 2.0 * x * x),
          y * g + d.p1 * (r2 + 2.0 * y * y) + 2.0 * d.p2 * x * y};
}

Matrix2d DistortionJacobian(const BrownConrady& d, const Vector2d& n) {
  const double x = n.x();
  const double y = n.y();
  const double r2 = x * x + y * y;
  const double g = 1.0 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  const double dg = d.k1 + r2 * (2.0 * d.k2 + r2 * 3.0 * d.k3);  // dg/d(r²)
  Matrix2d J;
  J(0, 0) = g + 2.0 * x * x * dg + 2.0 * d.p1 * y + 6.0 * d.p2 * x;
  J(0, 1) = 2.0 * x * y * dg + 2.0 * d.p1 * x + 2.0 * d.p2 * y;
  J(1, 0) = J(0, 1);
  J(1, 1) = g + 2.0 * y * y * dg + 6.0 * d.p1 * y + 2.0 * d.p2 * x;
  return J;
}

void Validate(const CameraParameters& p) {
  Faults faults("camera");
  faults.Require(
      p.width_px >= 1 && p.width_px <= 16384 && p.height_px >= 1 && p.height_px <= 16384,
      fmt::format("image size {} x {} px is not between 1 and 16384", p.width_px, p.height_px));
  faults.Require(std::isfinite(p.fx_px) && p.fx_px > 0.0 && std::isfinite(p.fy_px) && p.fy_px > 0.0,
                 fmt::format("focal lengths {} and {} px are not positive", p.fx_px, p.fy_px));
  faults.Require(std::isfinite(p.cx_px) && std::isfinite(p.cy_px), "principal point is not finite");
  const BrownConrady& d = p.distortion;
  faults.Require(std::isfinite(d.k1) && std::isfinite(d.k2) && std::isfinite(d.p1) &&
                     std::isfinite(d.p2) && std::isfinite(d.k3),
                 "distortion coefficients are not finite");
  faults.ThrowIfAny();
}

}  // namespace

CameraModel::CameraModel(const CameraParameters& parameters) : parameters_(parameters) {
  Validate(parameters_);
  max_radius_ = LargestMonotonicRadius(parameters_.distortion);
}

CameraModel CameraModel::Pinhole(int width_px, int height_px, double f_px) {
  return CameraModel({.width_px = width_px,
                      .height_px = height_px,
                      .fx_px = f_px,
                      .fy_px = f_px,
                      .cx_px = 0.5 * (width_px - 1),
                      .cy_px = 0.5 * (height_px - 1),
                      .distortion = {}});
}

std::optional<Vector2d> CameraModel::Project(const Vector3d& p_CQ) const {
  if (!(p_CQ.z() > 0.0)) return std::nullopt;
  const Vector2d n(p_CQ.x() / p_CQ.z(), p_CQ.y() / p_CQ.z());
  if (!(n.norm() <= max_radius_)) return std::nullopt;
  const Vector2d d = Distort(parameters_.distortion, n);
  return Vector2d(parameters_.fx_px * d.x() + parameters_.cx_px,
                  parameters_.fy_px * d.y() + parameters_.cy_px);
}

std::optional<CameraModel::Linearisation> CameraModel::Linearise(const Vector3d& p_CQ) const {
  const auto pixel = Project(p_CQ);
  if (!pixel) return std::nullopt;
  const double inverse_z = 1.0 / p_CQ.z();
  const double x = p_CQ.x() * inverse_z;
  const double y = p_CQ.y() * inverse_z;
  const double r2 = x * x + y * y;
  const double fx = parameters_.fx_px;
  const double fy = parameters_.fy_px;
  Eigen::Matrix<double, 2, 3> normalised_by_point;
  normalised_by_point << inverse_z, 0.0, -x * inverse_z, 0.0, inverse_z, -y * inverse_z;
  Linearisation result;
  result.pixel = *pixel;
  result.by_point = Vector2d(fx, fy).asDiagonal() *
                    DistortionJacobian(parameters_.distortion, {x, y}) * normalised_by_point;
  result.by_parameters << (pixel->x() - parameters_.cx_px) / fx, 0.0, 1.0, 0.0, fx * x * r2,
      fx * x * r2 * r2, fx * 2.0 * x * y, fx * (r2 + 2.0 * x * x), fx * x * r2 * r2 * r2, 0.0,
      (pixel->y() - parameters_.cy_px) / fy, 0.0, 1.0, fy * y * r2, fy * y * r2 * r2,
      fy * (r2 + 2.0 * y * y), fy * 2.0 * x * y, fy * y * r2 * r2 * r2;
  return result;
}

Eigen::Matrix<double, 9, 1> CameraModel::ParameterVector() const {
  const CameraParameters& p = parameters_;
  const BrownConrady& d = p.distortion;
  Eigen::Matrix<double, 9, 1> vector;
  vector << p.fx_px, p.fy_px, p.cx_px, p.cy_px, d.k1, d.k2, d.p1, d.p2, d.k3;
  return vector;
}

CameraModel CameraModel::WithParameters(const Eigen::Matrix<double, 9, 1>& p) const {
  return CameraModel({.width_px = width_px(),
                      .height_px = height_px(),
                      .fx_px = p[0],
                      .fy_px = p[1],
                      .cx_px = p[2],
                      .cy_px = p[3],
                      .distortion = {.k1 = p[4], .k2 = p[5], .p1 = p[6], .p2 = p[7], .k3 = p[8]}});
}

std::optional<Vector3d> CameraModel::UnprojectRay(const Vector2d& pixel) const {
  const Vector2d target((pixel.x() - parameters_.cx_px) / parameters_.fx_px,
                        (pixel.y() - parameters_.cy_px) / parameters_.fy_px);
  if (!has_distortion()) {
    if (!(target.norm() <= max_radius_)) return std::nullopt;
    return Vector3d(target.x(), target.y(), 1.0);
  }
  // Newton's method, kept inside the valid domain, where the Jacobian is regular.
  Vector2d n = target;
  for (int i = 0; i < 50; ++i) {
    if (n.norm() > max_radius_) n *= max_radius_ / n.norm();
    const Vector2d residual = Distort(parameters_.distortion, n) - target;
    if (!residual.allFinite()) return std::nullopt;
    if (residual.norm() < 1e-15) break;
    const Vector2d step = DistortionJacobian(parameters_.distortion, n).inverse() * residual;
    if (!step.allFinite()) return std::nullopt;
    n -= step;
    if (step.norm() < 1e-16) break;
  }
  const double residual = (Distort(parameters_.distortion, n) - target).norm();
  const bool converged = residual < 1e-12 * (1.0 + target.norm());
  if (!converged || !(n.norm() <= max_radius_)) return std::nullopt;
  return Vector3d(n.x(), n.y(), 1.0);
}

std::optional<Vector3d> CameraModel::UnprojectRay(const Vector2d& pixel,
                                                  const Vector2d& near) const {
  if (!has_distortion()) return UnprojectRay(pixel);
  const Vector2d target((pixel.x() - parameters_.cx_px) / parameters_.fx_px,
                        (pixel.y() - parameters_.cy_px) / parameters_.fy_px);
  // Newton's method doubles the right digits in each step: from a part of 1e-4 pixels, one will do.
  Vector2d n = near;
  for (int i = 0; i < 3 && n.squaredNorm() <= max_radius_ * max_radius_; ++i) {
    const Vector2d residual = Distort(parameters_.distortion, n) - target;
    if (residual.squaredNorm() < 1e-13 * 1e-13) return Vector3d(n.x(), n.y(), 1.0);
    n -= DistortionJacobian(parameters_.distortion, n).inverse() * residual;
  }
  return UnprojectRay(pixel);  // A poor guess, or an edge of the valid domain.
}

bool CameraModel::Contains(const Vector2d& pixel) const {
  return pixel.x() >= -0.5 && pixel.x() <= parameters_.width_px - 0.5 && pixel.y() >= -0.5 &&
         pixel.y() <= parameters_.height_px - 0.5;
}

CameraModel CameraModel::Scaled(double s) const {
  CameraParameters scaled = parameters_;
  scaled.width_px = static_cast<int>(std::lround(s * parameters_.width_px));
  scaled.height_px = static_cast<int>(std::lround(s * parameters_.height_px));
  scaled.fx_px = s * parameters_.fx_px;
  scaled.fy_px = s * parameters_.fy_px;
  scaled.cx_px = s * (parameters_.cx_px + 0.5) - 0.5;
  scaled.cy_px = s * (parameters_.cy_px + 0.5) - 0.5;
  return CameraModel(scaled);
}

Eigen::Matrix3d CameraModel::Matrix() const {
  Eigen::Matrix3d K;
  K << parameters_.fx_px, 0.0, parameters_.cx_px, 0.0, parameters_.fy_px, parameters_.cy_px, 0.0,
      0.0, 1.0;
  return K;
}

}  // namespace fenestra
