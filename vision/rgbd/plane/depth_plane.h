#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/random/random_stream.h"
#include "vision/rgbd/plane/depth_points.h"

namespace fenestra {

/// Noise of a depth sensor that triangulates. Disparity is proportional to inverse depth, so all of
/// these quantities are independent of depth; multiplied by z² they are lengths along the optical
/// axis.
struct DepthNoise {
  double sigma;          ///< Typical standard deviation of a pixel's inverse depth [1/m].
  double step;           ///< Quantum of the inverse depth [1/m]; 0: none.
  double window_px;      ///< Side of the block with which a pixel was matched.
  double window_points;  ///< Number of points read per block.
  double window_rad;     ///< Angle that a block covers, in the middle of the image.
  cv::Size image;        ///< Size of the depth image.
  double farthest;       ///< Inverse of the largest depth that the sensor gives [1/m].
};

/// A plane { p : m·p = 1 } in D that depth points lie on.
struct DepthPlane {
  Eigen::Vector3d m;            ///< [1/m]
  Eigen::Matrix3d information;  ///< Inverse covariance of m [m²].
  double sigma;                 ///< Measured standard deviation of a point's inverse depth [1/m].
  std::vector<bool> is_inlier;  ///< For each point.
  int inliers;

  /// Relative standard deviation of the plane's depth where the ray through a point meets it.
  double RelativeSigmaAt(const Eigen::Vector3d& p_DQ) const;

  /// Signed distance of a depth point from the plane, positive towards the camera [m].
  double Distance(const DepthPoint& point) const;
};

/// Finds the plane on which most points lie. The inverse depth of the points of a plane is linear
/// in their rays,
///
///     1/z = m·r,    r = (x, y, 1),
///
/// so least squares over the inverse depths weights each point by z⁻⁴ and needs no initial value.
/// The plane is found by random sample consensus (Fischler & Bolles 1981) and refitted without
/// points beyond 3.5 standard deviations. Neighbouring points share most of their blocks, so n
/// points carry the information of n/w independent ones, with w the number of points per block.
///
/// Returns nullopt if fewer than `least_points` lie on one plane or if they do not span it.
std::optional<DepthPlane> FindDepthPlane(const std::vector<DepthPoint>& points,
                                         const DepthNoise& noise, int least_points,
                                         const RandomStream& triples);

/// Measures a plane near a known one more carefully than FindDepthPlane. Whole tiles of the image,
/// several blocks wide, are left out if their mean is off by 3.5 of its own standard deviations,
/// which reveals steps that are too low to show in single points. The information is corrected by
/// the scatter of the tiles' means around the plane. After noise has smoothed the quantisation, a
/// sinusoid over the inverse depth remains, with amplitude
///
///     A = (q/π) exp(-2 π² σ²/q²),    q: the quantum, σ: noise without quantisation
///
/// (the first term of the Fourier series of a rounded mean). It is the same for all points at one
/// depth and is added to the covariance; it matters for walls seen head-on.
///
/// Points are left out where noise could lift the plane beyond the largest depth that the sensor
/// reports, since only the nearer half of them would be reported. The nearer side of a block has
/// brighter dots, by the inverse square law, so that the block is matched slightly too near,
///
///     Δm/m = 2 V/ζ²,   V = (m_x² + m_y²) w²/12,   ζ: inverse depth in the middle,
///
/// with w the angle that a block covers and V the variance of the inverse depth within it. This
/// bias is subtracted, and the same amount is added to the standard deviation.
std::optional<DepthPlane> MeasureDepthPlane(const std::vector<DepthPoint>& points,
                                            const Eigen::Vector3d& start, const DepthNoise& noise,
                                            int least_points);

}  // namespace fenestra
