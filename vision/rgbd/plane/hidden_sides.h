#pragma once

#include "vision/frame/adjustment/frame_fit.h"
#include "vision/rgbd/plane/frame_planes.h"

namespace fenestra {

/// Moves a frame `by_m` farther behind the wall and scales it so that a camera at p_LC sees it
/// unchanged.
FrameRectangle SetBack(const FrameRectangle& frame, const Eigen::Vector3d& p_LC, double by_m);

/// Corrects a frame for which all sides were assumed to be seen in the plane of its front. Sides
/// that the reveal hides from a camera at p_LC are moved to the edge that is seen instead, the edge
/// of the wall's face `setback_m` in front of the frame.
FrameRectangle WithHiddenSides(const FrameRectangle& frame, const Eigen::Vector3d& p_LC,
                               double setback_m);

/// Adds the uncertainty of the setback to the covariance of a frame's centroid: along the normal,
/// unless the fit contains it, and across it.
void AddSetback(const CameraView& view, bool is_fitted, const FramePlanes& planes, FrameFit& fit);

}  // namespace fenestra
