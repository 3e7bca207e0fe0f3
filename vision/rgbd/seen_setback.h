#pragma once

#include "vision/frame/frame_fit.h"
#include "vision/rgbd/frame_planes.h"

namespace fenestra {

/// The frame that a camera at p_LC sees alike, with its front `by_m` farther behind the wall.
FrameRectangle SetBack(const FrameRectangle& frame, const Eigen::Vector3d& p_LC, double by_m);

/// A frame whose sides all were taken to be seen in its front's plane, with those that its reveal
/// hides from a camera at p_LC moved to where they are seen, the edge of the wall's face
/// `setback_m` before the front.
FrameRectangle WithHiddenSides(const FrameRectangle& frame, const Eigen::Vector3d& p_LC,
                               double setback_m);

/// Adds to the covariance of a frame's centroid what is not known of its setback: along the normal,
/// unless the fit has it, and across it.
void AddSetback(const CameraView& view, bool is_fitted, const FramePlanes& planes, FrameFit& fit);

}  // namespace fenestra
