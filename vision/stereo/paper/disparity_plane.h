#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "vision/stereo/rectification.h"

namespace fenestra {

/// One matched pixel of the rectified left image.
struct DisparitySample {
  float u_px;
  float v_px;
  float disparity_px;
};

/// A plane in space as the rectified pair sees it. For n·p = h in frame F,
///
///     d(u, v) = a u + b v + c,    a = B n_x / h,   b = B n_y / h,
///     c = (B / h) (f n_z - n_x cx - n_y cy)
///
/// exactly. The noise of matching is the same for near and far pixels in d but not in space, so
/// planes are fitted to disparities and not to 3-D points.
struct DisparityPlane {
  double a = 0.0;
  double b = 0.0;
  double c = 0.0;  ///< [px]

  double At(const Eigen::Vector2d& pixel) const { return a * pixel.x() + b * pixel.y() + c; }
  double Residual(const DisparitySample& s) const {
    return s.disparity_px - (a * s.u_px + b * s.v_px + c);
  }

  /// The point of the plane, in F, that a pixel shows; nullopt if the plane is behind the camera or
  /// at infinity there (d ≤ 0).
  std::optional<Eigen::Vector3d> PointAt(const Eigen::Vector2d& pixel,
                                         const RectifiedCamera& camera) const;
  /// Unit normal in F, pointing towards the camera.
  Eigen::Vector3d Normal(const RectifiedCamera& camera) const;
};

struct DisparityPlaneFit {
  DisparityPlane plane;
  double inlier_share = 0.0;  ///< Share of the samples within the tolerance of the plane.
};

/// Fits a plane with Tukey's biweight by iteratively reweighted least squares, starting from least
/// absolute deviations: P. J. Huber, "Robust Statistics", 1981, ch. 7. Residuals beyond
/// `tolerance_px` have no weight. Returns nullopt for samples that do not determine a plane (fewer
/// than three, or on one line).
std::optional<DisparityPlaneFit> FitDisparityPlane(const std::vector<DisparitySample>& samples,
                                                   double tolerance_px);

}  // namespace fenestra
