#pragma once

#include "core/geometry/camera_model.h"
#include "vision/rgbd/paper/cloud_shape.h"
#include "vision/rgbd/paper/dark_cloud.h"
#include "vision/rgbd/paper/diagonals.h"

namespace fenestra {

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
