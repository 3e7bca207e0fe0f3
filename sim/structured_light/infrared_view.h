#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "core/geometry/camera_model.h"
#include "renderers/ray_caster.h"
#include "renderers/tracing/ray_grid.h"
#include "sim/motion/rolling_shutter.h"

namespace fenestra {

/// Truths along several rays through each of some pixels.
struct PixelParts {
  static constexpr int kPerPixel = 8;

  std::vector<cv::Point> pixels;
  AovImages aovs;  ///< Of the rays in turn, row by row: kPerPixel for each pixel.

  /// Position of a part's truths in `aovs`.
  cv::Point PlaceOf(size_t pixel, int part) const {
    const int ray = static_cast<int>(pixel) * kPerPixel + part;
    return {ray % aovs.depth_m.cols, ray / aovs.depth_m.cols};
  }
  /// Offset of the part's ray from the pixel's centre [px]. Along u and along v, each part is in
  /// its own eighth of the pixel.
  static Eigen::Vector2d OffsetOf(int part);
};

/// The view of an infra-red camera: truths along one ray through each pixel's centre, and along
/// several rays where outlines or shadows cross pixels.
struct InfraredView {
  AovImages aovs;
  std::vector<PixelParts> parts;
};

/// The infra-red image in which depth is matched.
///
/// Blocks that reach `reach` pixels from their centre lie in an image `2 reach` pixels larger than
/// their centres. The camera has these rows to spare, but not these columns: depth pixel (u, v) is
/// matched by the block around infra-red pixel (scale u + reach.width, scale v + reach.height), the
/// depth image is as wide as the infra-red one, and its last 2 reach.width / scale columns have no
/// block. ROS kinect_calibration/technical finds depth displaced by 4.8 and 3.9 px against the
/// infra-red image; raw depth images of Kinects have 8 empty columns on the right and no others.
struct InfraredImageLayout {
  int scale = 1;   ///< Infra-red pixels per depth pixel.
  cv::Size reach;  ///< [infra-red px]

  /// The infra-red camera of this depth camera: each of its pixels has the ray of the depth pixel
  /// that it is the centre of.
  CameraModel CameraOf(const CameraModel& depth) const;
  /// From the first row of CameraOf to the last, if the depth image's own rows take readout_s.
  RollingShutter ShutterOf(const CameraModel& depth, const RollingShutter& shutter) const;
  cv::Point CentreOf(cv::Point depth_pixel) const {
    return scale * depth_pixel + cv::Point(reach.width, reach.height);
  }
  /// Whether a depth pixel's block lies in the infra-red image.
  bool HasBlock(cv::Point depth_pixel, const CameraModel& depth) const {
    return CentreOf(depth_pixel).x + reach.width < scale * depth.width_px();
  }
};

/// Casts the rays of an infra-red camera, which is the rig's frame. Frame C: the camera; p_CP: the
/// projector. X_WC: the pose in the middle of the image, if the rig moves.
class InfraredRays {
 public:
  /// `camera`: without distortion.
  explicit InfraredRays(const CameraModel& camera, const RollingShutter& shutter = {});

  const CameraModel& camera() const { return rays_.camera(); }
  cv::Size size() const { return {camera().width_px(), camera().height_px()}; }
  /// The ray through any place of the image, z = 1.
  Eigen::Vector3d RayAt(double u_px, double v_px) const;

  InfraredView Cast(const RayCaster& caster, const Pose& X_WC, const Lighting& lighting,
                    const Eigen::Vector3d& p_CP) const;

 private:
  PixelParts CastParts(const RayCaster& caster, const Pose& X_WC, const Lighting& lighting,
                       const Eigen::Vector3d& p_WP, std::vector<cv::Point> pixels) const;

  MovingRays rays_;
  /// The same camera with so few pixels that offsets take its rays to any place of the image.
  RayGrid few_rays_;
};

/// The pixels next to an outline or a shadow, in order: those with a neighbour that sees another
/// object, or another depth by more than a quarter of a pixel of disparity, f b (1/z - 1/z'), or
/// that differs in being in the shadow of the sun or of the projector. `fb`: f b [px m].
std::vector<cv::Point> CrossedPixels(const AovImages& aovs, double fb);

}  // namespace fenestra
