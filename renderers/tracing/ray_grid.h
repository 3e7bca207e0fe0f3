#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/camera_model.h"

namespace fenestra {

/// The rays of all pixels of a camera, undistorted once: normalised image coordinates (X/Z, Y/Z)
/// at the pixel corners, between which samples are interpolated bilinearly (with
/// 10 % barrel distortion over 400 px the error is below 2e-4 px, far from the centre). Lens
/// distortion is thus part of the rays; no image is ever warped.
class RayGrid {
 public:
  /// Throws InputError if a pixel of the image lies outside the camera's valid domain.
  explicit RayGrid(const CameraModel& camera);

  const CameraModel& camera() const { return camera_; }
  int width_px() const { return camera_.width_px(); }
  int height_px() const { return camera_.height_px(); }

  /// (X/Z, Y/Z) at the pixel corner (column - 0.5, row - 0.5), column ≤ width, row ≤ height.
  const Eigen::Vector2f& Corner(int column, int row) const {
    return corners_[static_cast<size_t>(row) * static_cast<size_t>(width_px() + 1) +
                    static_cast<size_t>(column)];
  }

  /// All corners row by row, width + 1 each: x and y in turns.
  const float* corner_data() const { return corners_.data()->data(); }

 private:
  CameraModel camera_;
  std::vector<Eigen::Vector2f> corners_;
};

}  // namespace fenestra
