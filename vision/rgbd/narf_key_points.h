#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "core/camera_model.h"

namespace fenestra {

/// An interest point of a range image.
struct KeyPoint {
  Eigen::Vector2i pixel;  ///< Of the depth image.
  Eigen::Vector3d p_KQ;   ///< [m]
};

struct NarfSettings {
  double support_size_m;      ///< Diameter of the surface patch that is judged; positive.
  double min_interest_value;  ///< From 0 to 1.
};

/// Algorithm 2 of the paper: a range image of a cloud, and NARF key points on it (B. Steder,
/// R. B. Rusu, K. Konolige, W. Burgard, "Point feature extraction on 3D range scans taking into
/// account object boundaries", ICRA 2011), both PCL's.
///
/// The range image is planar and has the pixels of the camera, or every n-th of them: each point of
/// the cloud keeps the pixel that it came from. A spherical image, or PCL's z-buffer for unordered
/// clouds, would resample; the z-buffer also spreads points to neighbouring pixels by the last bit
/// of a float.
class NarfRangeImage {
 public:
  /// `depth_m`: 0 where the cloud has no point. With `unseen_is_far`, such pixels are taken for
  /// free sight to infinity. Without it a cloud that holds nothing but the frame has no borders,
  /// since PCL does not set a border against the unknown, and NARF finds nothing at all.
  ///
  /// Only every `stride`-th row and column of the depth image is taken.
  ///
  /// The camera must be free of distortion and its image narrower than twice its focal length (a
  /// horizontal field of 90°), beyond which PCL's angular resolution is not a number.
  NarfRangeImage(const cv::Mat1f& depth_m, const CameraModel& camera, int stride,
                 bool unseen_is_far);
  ~NarfRangeImage();

  /// In one thread. Cost grows with the square of the support size in pixels.
  std::vector<KeyPoint> DetectKeyPoints(const NarfSettings& settings) const;

  /// Whether a camera is in the domain of the constructor.
  static bool Supports(const CameraModel& camera);

 private:
  struct Impl;  // Keeps PCL's headers out of every other file.
  std::unique_ptr<const Impl> impl_;
  int stride_;
};

}  // namespace fenestra
