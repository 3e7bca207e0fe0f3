#pragma once

#include <opencv2/core.hpp>

#include "core/geometry/camera_model.h"
#include "core/geometry/pose.h"

namespace fenestra::testing {

/// A square frame painted on an endless plane, for tests of detectors without the renderer. Frame
/// O: origin at the square's centre, +x right, +y up, +z out of the wall.
struct PlanarTarget {
  double outer_side_m = 1.0;
  double border_m = 0.1;
};

/// Fraction of each pixel that the border covers, from samples² rays per pixel.
cv::Mat1f BorderCoverage(const CameraModel& camera, const Pose& X_CO, const PlanarTarget& target,
                         int samples = 8);

/// Depth of the plane at each pixel centre [m]; NaN where the ray misses it.
cv::Mat1f PlaneDepth(const CameraModel& camera, const Pose& X_CO);

/// X_CO of a window that a camera faces squarely from `distance_m`, the optical axis through the
/// point `offset_m` (right, down) away from the centroid.
Pose FacingWindow(double distance_m, const Eigen::Vector2d& offset_m = Eigen::Vector2d::Zero());

}  // namespace fenestra::testing
