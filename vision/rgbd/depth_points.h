#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "core/calibration.h"
#include "core/observation.h"

namespace fenestra {

/// A pixel of a depth image that has a return.
struct DepthPoint {
  cv::Point pixel;
  Eigen::Vector3d ray_D;    ///< (x, y, 1)
  double inverse_depth;     ///< 1/z [1/m]
  Eigen::Vector2f seen_px;  ///< Where the colour camera, freed of distortion, sees it.
};

/// Reads depth images. Pixels that share most of the window in which the sensor matched them tell
/// nothing new, so only every so many columns are read, of which about 320 are left, and half as
/// many rows. (Where windows are 4.5 pixels wide, every second row leaves the variance of a mean
/// 2 % larger.)
class DepthPointReader {
 public:
  explicit DepthPointReader(const RgbdCalibration& calibration);

  /// The image must have the size of the calibration.
  std::vector<DepthPoint> Read(const DepthImage& depth) const;

  int columns() const { return columns_; }  ///< Every so many are read.
  int rows() const { return rows_; }

 private:
  struct Ray {
    cv::Point pixel;
    Eigen::Vector3d ray_D;
    Eigen::Vector3d turned;  ///< R_KD ray_D
  };
  std::vector<Ray> rays_;
  Eigen::Vector3d p_KD_;
  CameraParameters color_;
  int columns_;
  int rows_;
};

}  // namespace fenestra
