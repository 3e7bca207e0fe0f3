#pragma once

#include <Eigen/Core>

namespace fenestra {

/// The rectified pair: two pinhole cameras with the same K and parallel axes, the right one
/// displaced by the baseline along +x. Frame F is that of the rectified left camera; it shares its
/// origin with L.
///
///     u = f X/Z + cx,   v = f Y/Z + cy                                    (rectified left pixel)
///     d = u_left - u_right = f B / Z                                      (disparity)
///
/// f, cx, cy, d [px]; B, X, Y, Z [m].
struct RectifiedCamera {
  double f_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  double baseline_m = 0.0;

  /// Converts by Z = f B / d. Domain: positive values. First-order error: σ_Z = Z² σ_d / (f B).
  double DepthFromDisparity(double disparity_px) const { return f_px * baseline_m / disparity_px; }
  double DisparityFromDepth(double depth_m) const { return f_px * baseline_m / depth_m; }

  /// The direction (x, y, 1) of a pixel's ray in F.
  Eigen::Vector3d Ray(const Eigen::Vector2d& pixel) const {
    return {(pixel.x() - cx_px) / f_px, (pixel.y() - cy_px) / f_px, 1.0};
  }
};

}  // namespace fenestra
