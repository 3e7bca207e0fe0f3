#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace fenestra {

/// Corners in the image, clockwise as seen: top left, top right, bottom right, bottom left.
using Quadrilateral = std::array<Eigen::Vector2d, 4>;

/// a × b [px²]; positive where a turns clockwise, as seen, into b.
double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// Whether it turns clockwise at every corner.
bool IsConvex(const Quadrilateral& quadrilateral);

/// Fits a convex quadrilateral to a closed contour. Its four sides are lines fitted to the
/// contour's points with Huber's loss, leaving out the ends of each side, where the neighbouring
/// side would bias the fit. Its corners are the intersections of these lines and so have sub-pixel
/// resolution. Points are assigned to sides by the Ramer–Douglas–Peucker polygon of the contour's
/// convex hull, with the smallest tolerance that leaves four corners.
///
/// Returns nullopt if no tolerance up to a tenth of the perimeter leaves four corners, or if the
/// lines enclose no convex area.
std::optional<Quadrilateral> FitQuadrilateral(const std::vector<cv::Point>& contour);

/// Moves each side inwards by the reach of a square of half side `half_px` with axis-parallel
/// sides: h (|n_x| + |n_y|) for a side with unit normal n. This undoes a dilation with that square.
/// Returns nullopt if nothing is left.
std::optional<Quadrilateral> Inset(const Quadrilateral& quadrilateral, double half_px);

/// Signed area [px²]; positive for corners in clockwise order.
double Area(const Quadrilateral& quadrilateral);

/// Bilinear map from the unit square to the quadrilateral: (0, 0) is the top left corner, (1, 1)
/// the bottom right one.
Eigen::Vector2d At(const Quadrilateral& quadrilateral, double s, double t);

/// How nearly four corners form a rectangle.
struct WindowShape {
  double width_m = 0.0;   ///< Mean of the upper and the lower side.
  double height_m = 0.0;  ///< Mean of the left and the right side.
  /// Largest departure of a corner from a right angle [rad].
  double skew_rad = 0.0;
  /// Largest relative difference of opposite sides.
  double taper = 0.0;
};

/// Measures the shape of four corners, given in the order of WindowEstimate.
WindowShape MeasureShape(const std::array<Eigen::Vector3d, 4>& p_CV);

}  // namespace fenestra
