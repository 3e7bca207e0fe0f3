#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/detection.h"
#include "vision/frame/quadrilateral.h"
#include "vision/frame/window_shape.h"
#include "vision/stereo/disparity_plane.h"

namespace fenestra {

/// The window in the rectified left camera F: each corner is the point where its pixel's ray
/// meets the frame's plane, the centroid the intersection of the diagonals. (In a rectangle that
/// is the centre, and unlike the mean of the corners it is so for the perspective image, too.)
/// nullopt if a corner's ray does not meet the plane in front of the camera.
std::optional<WindowEstimate> WindowOnPlane(const Quadrilateral& corners_px,
                                            const DisparityPlane& plane,
                                            const RectifiedCamera& camera);

/// The same window in the frame C that R_CF turns F to.
WindowEstimate Rotated(const Eigen::Matrix3d& R_CF, const WindowEstimate& estimate_F);

}  // namespace fenestra
