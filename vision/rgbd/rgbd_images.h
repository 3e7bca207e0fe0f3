#pragma once

#include <opencv2/core.hpp>

#include "core/detection/observation.h"
#include "core/geometry/calibration.h"
#include "core/geometry/camera_model.h"

namespace fenestra {

/// Returns the images of an RGB-D observation. Throws InputError for a stereo observation.
const RgbdObservation& RgbdPart(const Observation& observation);

/// Throws InputError for a calibration with a depth unit that DepthUnitObjection refuses.
void CheckDepthUnit(const RgbdCalibration& calibration);

/// Throws InputError with all faults if the image sizes or the depth unit are not those of the
/// calibration.
void CheckFits(const RgbdObservation& observation, const RgbdCalibration& calibration);

/// Returns the camera without its distortion: a pinhole with the same focal lengths, principal
/// point and image size.
CameraModel WithoutDistortion(const CameraModel& camera);

/// Map for cv::remap: the place in the distorted image of each pixel of the camera without
/// distortion, or a place far outside the image where the lens sees nothing.
cv::Mat2f UndistortionMap(const CameraModel& camera);

/// Draws depth in false colours, from its smallest value in the image (red) to its largest (blue);
/// pixels without depth are black.
cv::Mat3b DrawDepth(const cv::Mat1f& depth_m);

/// Converts a colour image to grey values that are linear in the light: the mean of its channels,
/// decoded from sRGB (IEC 61966-2-1), times a factor of at least 1 that brings the 98th percentile
/// to 200 DN, so that rounding adds little to the noise of a dark image; clipped at 255. An edge
/// between two areas is a blurred step in this image, but not in the encoded one. An empty image
/// gives an empty one.
cv::Mat1b LinearGrey(const cv::Mat3b& color);

}  // namespace fenestra
