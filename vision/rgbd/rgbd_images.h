#pragma once

#include <opencv2/core.hpp>

#include "core/detection/observation.h"
#include "core/geometry/calibration.h"
#include "core/geometry/camera_model.h"

namespace fenestra {

/// Throws InputError with all faults if the image sizes or the depth unit are not those of the
/// calibration.
void CheckFits(const RgbdObservation& observation, const RgbdCalibration& calibration);

/// Returns the camera without its distortion.
CameraModel WithoutDistortion(const CameraModel& camera);

/// Map for cv::remap: the place in the distorted image of each pixel of the camera without
/// distortion, or a place far outside the image where the lens sees nothing.
cv::Mat2f UndistortionMap(const CameraModel& camera);

/// Draws depth in false colours, from its smallest value in the image (red) to its largest (blue);
/// pixels without depth are black.
cv::Mat3b DrawDepth(const cv::Mat1f& depth_m);

}  // namespace fenestra
