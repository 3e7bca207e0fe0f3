#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "vision/rgbd/paper/diagonals.h"

namespace fenestra {

/// Chooses the paper's "four characteristic points which approximately represent the four
/// vertices". The paper does not say how four are chosen out of more; here it is the four points
/// that span the largest quadrilateral. Its corners lie on the convex hull, so every choice of four
/// hull points is tried, which is n⁴/24 areas for n hull points.
///
/// Returns indices in the order of ConvexHull; nullopt if the hull has fewer than four points.
std::optional<std::array<int, 4>> LargestQuadrilateral(const std::vector<Eigen::Vector2d>& points);

/// Reorders an outline so that it starts at the top left and runs clockwise as seen in the image:
/// top left, top right, bottom right, bottom left. The top left vertex is the one with the smallest
/// x/z + y/z. Domain: all z are positive.
FourVertices OrderedAsSeen(const FourVertices& p_CV);

}  // namespace fenestra
