#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "core/detection/observation.h"
#include "core/geometry/camera_model.h"
#include "core/geometry/pose.h"

namespace fenestra {

/// Reprojects depth images from their own camera D to another camera K, as drivers and detectors
/// register depth to colour. Every depth pixel becomes a point,
///
///     p_K = X_KD (z r_D),   r_D = (x, y, 1) the ray of the pixel in D,
///
/// and is rounded to the nearest pixel of K; of several points, the nearest wins. Pixels of K stay
/// empty if K is rolled against D or if its pixels are finer. A surface that only K sees is empty,
/// too, or shows what D sees behind it.
class DepthReprojection {
 public:
  DepthReprojection(const CameraModel& from, const Pose& X_KD, const CameraModel& to);

  /// The source of a pixel onto which no pixel of `from` falls.
  static constexpr int kNowhere = -1;
  /// For each pixel of `to` the index (row by row) of the pixel of `depth` that it shows, and its
  /// depth there [m]; kNowhere and 0 without one.
  struct Reprojected {
    cv::Mat1i source;
    cv::Mat1f depth_m;
  };
  /// `depth` must have the size of `from`.
  Reprojected Reproject(const DepthImage& depth) const;

 private:
  CameraModel to_;
  Eigen::Vector3d p_KD_;
  int width_px_;
  /// R_KD r_D of each depth pixel, row by row; nullopt where the lens has no ray.
  std::vector<std::optional<Eigen::Vector3d>> rays_K_;
};

}  // namespace fenestra
