#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "vision/rgbd/diagonals.h"

namespace fenestra {

/// The paper's "four characteristic points which approximately represent the four vertices". It
/// does not say how four are chosen out of more. Here: the four points that span the largest
/// quadrilateral. Its corners lie on the convex hull, so all fours of hull points are tried, which
/// is n⁴/24 areas for n hull points.
///
/// Returns indices in the order of ConvexHull; nullopt if the hull has fewer than four points.
std::optional<std::array<int, 4>> LargestQuadrilateral(const std::vector<Eigen::Vector2d>& points);

/// The same outline begun at the top left and going round as seen in the image: top left, top
/// right, bottom right, bottom left. The top left vertex is the one whose x/z + y/z is smallest.
/// All z must be positive.
FourVertices OrderedAsSeen(const FourVertices& p_CV);

}  // namespace fenestra
