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

/// The convex quadrilateral that a closed contour follows. Its four sides are lines fitted to the
/// contour's points (Huber's loss; the ends of each side left out, where the other side pulls), its
/// corners their intersections, so corners have sub-pixel resolution. Which points belong to which
/// side is decided by the Ramer–Douglas–Peucker polygon of the contour's convex hull, with the
/// smallest tolerance that leaves four corners.
///
/// nullopt if no tolerance up to a tenth of the perimeter does, or if the lines enclose nothing
/// convex.
std::optional<Quadrilateral> FitQuadrilateral(const std::vector<cv::Point>& contour);

/// Moves each side inwards by the reach of a square of half side `half_px` with axis-parallel
/// sides: h (|n_x| + |n_y|) for a side with unit normal n. It undoes a dilation with that square.
/// nullopt if nothing is left.
std::optional<Quadrilateral> Inset(const Quadrilateral& quadrilateral, double half_px);

/// [px²]; positive for the order above.
double Area(const Quadrilateral& quadrilateral);

/// The point at (s, t) of the unit square stretched over the quadrilateral: (0, 0) is top left,
/// (1, 1) bottom right; bilinear.
Eigen::Vector2d At(const Quadrilateral& quadrilateral, double s, double t);

}  // namespace fenestra
