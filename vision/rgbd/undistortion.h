#pragma once

#include <opencv2/core.hpp>

#include "core/camera_model.h"

namespace fenestra {

/// The same camera with a perfect lens.
CameraModel WithoutDistortion(const CameraModel& camera);

/// For each pixel of that camera, where it lies in the distorted image; far outside of it where the
/// lens sees nothing. For cv::remap.
cv::Mat2f UndistortionMap(const CameraModel& camera);

}  // namespace fenestra
