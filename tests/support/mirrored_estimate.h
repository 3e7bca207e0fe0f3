#pragma once

#include <algorithm>

#include "core/detection/detection.h"

namespace fenestra::testing {

/// Largest distance between `mirrored`'s centroid and corners and those of `estimate` with x turned
/// into width_m - x. Left and right corners change places.
inline double DistanceFromMirrored(const WindowEstimate& estimate, double width_m,
                                   const WindowEstimate& mirrored) {
  const auto off = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    return (q - Eigen::Vector3d(width_m - p.x(), p.y(), p.z())).norm();
  };
  double most = off(estimate.p_CO, mirrored.p_CO);
  for (size_t i = 0; i < 4; ++i) most = std::max(most, off(estimate.p_CV[i], mirrored.p_CV[i ^ 1]));
  return most;
}

}  // namespace fenestra::testing
