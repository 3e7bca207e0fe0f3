#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "core/detection/detection.h"
#include "core/geometry/camera_model.h"
#include "vision/rgbd/paper/cloud_shape.h"
#include "vision/rgbd/paper/dark_cloud.h"
#include "vision/rgbd/paper/diagonals.h"
#include "vision/rgbd/paper/narf_key_points.h"

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

/// Requirements on four points to be accepted as the vertices of a frame.
struct VertexLimits {
  double min_area_fraction = 0.0;  ///< Area of the quadrilateral over that of the cloud's hull.
  double min_side_ratio = 0.0;     ///< Shortest over longest side.
};

/// Four key points, as indices in the order of their outline, and the reason why they are not a
/// frame if they are not. If no four points are in convex position, there is only a miss.
struct FrameVertices {
  std::optional<std::array<int, 4>> chosen;
  std::optional<Miss> miss;
  double area_fraction = 0.0;  ///< Area of the chosen four over that of the cloud's hull.
};

/// Projects the key points that lie close to the cloud's plane onto it and chooses the four that
/// span the largest quadrilateral there.
FrameVertices ChooseFrameVertices(const std::vector<KeyPoint>& key_points, const CloudShape& shape,
                                  const PlaneTolerance& tolerance, const VertexLimits& limits);

/// Measures how much of the middle of a quadrilateral is filled: of the pixels within the
/// quadrilateral shrunk to half its size about its centre, the share for which the cloud has a
/// point on the plane. It is 0 for a frame whose border is at most a quarter of its side, 1 for a
/// dark board, and 0 if no pixel is within.
double FilledShare(const DarkCloud& cloud, const CameraModel& camera, const Plane& plane,
                   const PlaneTolerance& tolerance, const FourVertices& p_KV);

/// Measures how much of a quadrilateral's least seen side is covered by points of the cloud on the
/// plane. It is 1 for a frame without holes in its depth, since key points lie on the frame's
/// border. A place counts as seen if one of the nine pixels around it does.
double SeenShare(const DarkCloud& cloud, const CameraModel& camera, const Plane& plane,
                 const PlaneTolerance& tolerance, const FourVertices& p_KV);

}  // namespace fenestra
