#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/random_stream.h"
#include "vision/rgbd/depth_points.h"

namespace fenestra {

/// The noise of a sensor that triangulates. Disparity is proportional to inverse depth, so all of
/// these are the same at any depth; times z² they are lengths along the optical axis.
struct DepthNoise {
  double sigma;          ///< Usual standard deviation of a pixel's inverse depth [1/m].
  double step;           ///< Quantum of the inverse depth [1/m]; 0: none.
  double window_px;      ///< Side of the window in which a pixel was matched.
  double window_points;  ///< How many of the points that are read share a window.
  double window_rad;     ///< The angle that a window covers, in the image's middle.
  cv::Size image;        ///< Of the depth image.
  double farthest;       ///< Inverse of the largest depth that the sensor gives [1/m].
};

/// A plane { p : m·p = 1 } in D that depth points lie on.
struct DepthPlane {
  Eigen::Vector3d m;            ///< [1/m]
  Eigen::Matrix3d information;  ///< Of m: the inverse of its covariance [m²].
  double sigma;                 ///< Of a point's inverse depth, as measured [1/m].
  std::vector<bool> is_inlier;  ///< For each point.
  int inliers;

  /// Standard deviation of the plane's depth where a point's ray meets it, as a share of that
  /// depth.
  double RelativeSigmaAt(const Eigen::Vector3d& p_DQ) const;

  /// Distance of a depth point from the plane, positive towards the camera [m].
  double Distance(const DepthPoint& point) const;
};

/// The plane on which most points lie. The inverse depth of a plane's points is linear in their
/// rays,
///
///     1/z = m·r,    r = (x, y, 1),
///
/// so least squares over the inverse depths weighs each point by its z⁻⁴ and needs no start. Found
/// by random samples (Fischler & Bolles 1981), then without points beyond 3.5 standard deviations.
/// Information: n points know as much as n/w independent ones, w: the points in a window, as
/// neighbours share most of these.
///
/// nullopt if fewer than `least_points` lie on one plane or if they do not span it.
std::optional<DepthPlane> FindDepthPlane(const std::vector<DepthPoint>& points,
                                         const DepthNoise& noise, int least_points,
                                         const RandomStream& triples);

/// The same near a plane that is known, with more care. Whole blocks of the image, some windows
/// wide, are left out if their mean is off by 3.5 of its own standard deviations: a step that is
/// too low to show in single points shows there. And the information is corrected by what the means
/// of blocks scatter around the plane. What is left of quantisation after noise has smoothed it, a
/// sinusoid over the inverse depth with the amplitude
///
///     A = (q/π) exp(-2 π² σ²/q²),    q: the quantum, σ: noise without quantisation
///
/// (the first term of the Fourier series of a rounded mean), is the same for all points at one
/// depth, and is added to the covariance: it counts for walls that face the camera squarely.
///
/// Points are left out where noise could lift the plane over the largest depth that the sensor
/// gives: of those only the nearer half is there. And a window's nearer side has brighter dots, by
/// the inverse square, so that it is matched a little too near,
///
///     Δm/m = 2 V/ζ²,   V = (m_x² + m_y²) w²/12,   ζ: inverse depth in the middle,
///
/// with w the angle that a window covers and V the variance of the inverse depth in it. That is
/// taken off, and as much is added to the standard deviation.
std::optional<DepthPlane> MeasureDepthPlane(const std::vector<DepthPoint>& points,
                                            const Eigen::Vector3d& start, const DepthNoise& noise,
                                            int least_points);

}  // namespace fenestra
