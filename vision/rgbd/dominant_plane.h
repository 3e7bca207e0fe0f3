#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/random_stream.h"

namespace fenestra {

/// A plane n · p = d in frame K, with |n| = 1 and n pointing towards the camera (d < 0).
struct Plane {
  Eigen::Vector3d normal_K = -Eigen::Vector3d::UnitZ();
  double offset_m = 0.0;

  double SignedDistance(const Eigen::Vector3d& p_KQ) const { return normal_K.dot(p_KQ) - offset_m; }

  /// Coordinates in the plane of the point's foot: (right, down) where the camera looks at the
  /// plane, from the foot of the camera itself.
  Eigen::Vector2d Coordinates(const Eigen::Vector3d& p_KQ) const;
};

/// How far a point may lie from a plane that it belongs to: fixed_m + per_z2 z² [1/m], as the
/// error of depth from triangulation grows with the square of the depth z.
struct PlaneTolerance {
  double fixed_m = 0.0;
  double per_z2 = 0.0;

  double At(double z_m) const { return fixed_m + per_z2 * z_m * z_m; }
};

/// The plane that most points lie on: random sample consensus (Fischler & Bolles 1981) over 100
/// triples, scored on at most 1000 evenly spaced points, then total least squares over the points
/// within the tolerance. With half of the points on the plane, a clean triple is missed with
/// probability (1 − 1/8)^100 = 2e-6.
///
/// nullopt if the points do not span a plane or if the plane holds the camera itself.
std::optional<Plane> DominantPlane(const std::vector<Eigen::Vector3d>& points_K,
                                   const PlaneTolerance& tolerance, const RandomStream& triples);

}  // namespace fenestra
