#pragma once

#include "core/camera_model.h"
#include "vision/rgbd/dark_cloud.h"
#include "vision/rgbd/diagonals.h"
#include "vision/rgbd/dominant_plane.h"

namespace fenestra {

/// How much of the middle of a quadrilateral is filled: of the pixels within the quadrilateral
/// shrunk to half about its centre, the share that the cloud has on the plane. 0 for a frame with
/// a border of up to a quarter of its side, 1 for a dark board. 0 where no pixel is within.
double FilledShare(const DarkCloud& cloud, const CameraModel& camera, const Plane& plane,
                   const PlaneTolerance& tolerance, const FourVertices& p_KV);

/// How much of the least seen side of a quadrilateral the cloud has on the plane: 1 for a frame
/// without holes in its depth, as key points lie on the frame's border. Places are seen if one of
/// the nine pixels around them is.
double SeenShare(const DarkCloud& cloud, const CameraModel& camera, const Plane& plane,
                 const PlaneTolerance& tolerance, const FourVertices& p_KV);

}  // namespace fenestra
