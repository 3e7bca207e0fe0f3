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
