#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "core/geometry/camera_model.h"
#include "vision/rgbd/paper/depth_registration.h"

namespace fenestra {

/// The point cloud of the dark pixels, in the frame K of the camera that saw them.
struct DarkCloud {
  cv::Mat1b mask;     ///< 255 at every dark pixel, with or without depth.
  cv::Mat1f depth_m;  ///< Depth of the cloud's pixels; 0 elsewhere. The cloud as an image.
  std::vector<Eigen::Vector3d> points_K;  ///< Row by row.
  int dark_pixels = 0;
};

/// Algorithm 1 of Zhou, Flores, Lozano and Castillo, "Vision-based window estimation for MAV in
/// unknown urban environments", RED-UAS 2013:
///
///     for all pixels (i, j):  if R < t and G < t and B < t, push (i, j, depth(i, j)).
///
/// The paper leaves two things open. Points are back-projected to metres here, since the diagonals
/// of its last step are to be in the camera's frame; dark pixels without depth are left out.
/// Domain: both images have the same size, that of the camera.
DarkCloud SegmentDark(const RegisteredImages& images, const CameraModel& camera, int dark_below_dn);

/// Makes the cloud of the pixels whose `mask` is not 0, for pixels that are selected in another
/// way, such as by a known colour of the frame.
DarkCloud CloudOf(const cv::Mat1b& mask, const cv::Mat1f& depth_m, const CameraModel& camera);

/// Splits the cloud into parts that are connected in the image (8 neighbours), each with its own
/// mask. Returns at most `most` parts of at least `min_points` points, the largest first. This step
/// is not in the paper, whose target is the only dark object in view.
std::vector<DarkCloud> ConnectedParts(const DarkCloud& cloud, const CameraModel& camera,
                                      int min_points, size_t most);

}  // namespace fenestra
