#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "core/geometry/camera_model.h"

namespace fenestra {

/// An interest point of a range image.
struct KeyPoint {
  Eigen::Vector2i pixel;  ///< Pixel of the depth image.
  Eigen::Vector3d p_KQ;   ///< [m]
};

struct NarfSettings {
  double support_size_m;      ///< Diameter of the surface patch that is examined; positive.
  double min_interest_value;  ///< From 0 to 1.
};

/// Algorithm 2 of the paper: a range image of a cloud and its NARF key points (B. Steder, R. B.
/// Rusu, K. Konolige, W. Burgard, "Point feature extraction on 3D range scans taking into account
/// object boundaries", ICRA 2011), both as PCL implements them.
///
/// The range image is planar and has the pixels of the camera, or every n-th of them, so that each
/// point of the cloud keeps the pixel that it came from. A spherical image or PCL's z-buffer for
/// unordered clouds would resample the cloud, and rounding in the z-buffer would also spread points
/// to neighbouring pixels.
class NarfRangeImage {
 public:
  /// `depth_m` is 0 where the cloud has no point. With `unseen_is_far`, such pixels count as an
  /// unobstructed view to infinity. Without it, a cloud that contains only the frame has no
  /// borders, since PCL marks no border next to unknown pixels, and NARF finds nothing at all.
  ///
  /// Only every `stride`-th row and column of the depth image is used.
  ///
  /// The camera must have no distortion, and its image must be narrower than twice its focal length
  /// (a horizontal field of view of 90°), beyond which PCL's angular resolution is not a number.
  NarfRangeImage(const cv::Mat1f& depth_m, const CameraModel& camera, int stride,
                 bool unseen_is_far);
  ~NarfRangeImage();

  /// Runs in one thread. The cost grows with the square of the support size in pixels.
  std::vector<KeyPoint> DetectKeyPoints(const NarfSettings& settings) const;

  /// Tells whether a camera is in the domain of the constructor.
  static bool Supports(const CameraModel& camera);

 private:
  struct Impl;  // Keeps PCL's headers out of every other file.
  std::unique_ptr<const Impl> impl_;
  int stride_;
};

}  // namespace fenestra
