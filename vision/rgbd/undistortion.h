#pragma once

#include <opencv2/core.hpp>

#include "core/geometry/camera_model.h"

namespace fenestra {

/// Returns the camera without its distortion.
CameraModel WithoutDistortion(const CameraModel& camera);

/// Map for cv::remap: the place in the distorted image of each pixel of the camera without
/// distortion, or a place far outside the image where the lens sees nothing.
cv::Mat2f UndistortionMap(const CameraModel& camera);

}  // namespace fenestra
