#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/detection/detection.h"
#include "vision/frame/detection/quadrilateral.h"
#include "vision/frame/model/window_shape.h"
#include "vision/stereo/paper/disparity_plane.h"

namespace fenestra {

/// Computes the window in the frame F of the rectified left camera. Each corner is the point where
/// the ray of its pixel meets the window's plane, and the centroid is the intersection of the
/// diagonals. (For a rectangle this is the centre, and unlike the mean of the corners it is
/// invariant under perspective.) Returns nullopt if a corner's ray does not meet the plane in front
/// of the camera.
std::optional<WindowEstimate> WindowOnPlane(const Quadrilateral& corners_px,
                                            const DisparityPlane& plane,
                                            const RectifiedCamera& camera);

/// Transforms an estimate from frame F to frame C, which is rotated by R_CF.
WindowEstimate Rotated(const Eigen::Matrix3d& R_CF, const WindowEstimate& estimate_F);

}  // namespace fenestra
