#pragma once

#include <opencv2/core.hpp>
#include <span>

#include "core/detection/detection.h"
#include "core/detection/observation.h"
#include "core/detection/stage_log.h"
#include "core/geometry/calibration.h"
#include "sim/truth/ground_truth.h"

namespace fenestra {

/// Pictures for people. Here, and in no picture that a detector could read, truth and estimate are
/// drawn over what the sensors saw: truth in green, an estimate in magenta.

/// The picture with the outline and centroid of the true windows and of the estimate, where there
/// are any, in each of its views (points in the scored camera's frame C).
cv::Mat3b DrawTruthAndEstimate(const cv::Mat& image, std::span<const PictureView> views,
                               const GroundTruth* truth, const WindowEstimate* estimate);

/// Depth in false colours, near red to far blue; no return is black.
cv::Mat3b DrawDepth(const DepthImage& depth);

/// Why pixels have no return (NoReturn), in colours; white: they have one. docs/structured_light.md
/// has the legend.
cv::Mat3b DrawNoReturn(const cv::Mat1b& no_return);

/// The views of an observation's own images: of the left and the right image (stereo), of the
/// colour and of the depth image (RGB-D), as the nominal calibration has them.
std::array<PictureView, 2> ObservationViews(const SensorCalibration& calibration);

}  // namespace fenestra
