#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "core/geometry/calibration.h"
#include "experiments/cramer_rao/depth_information.h"
#include "experiments/cramer_rao/prior_knowledge.h"
#include "sim/camera/color_camera.h"

namespace fenestra {

/// Fisher information of a colour and a depth image. Unknowns: those of DepthMatrix, in the camera
/// of the depth image's pixels, and blur and levels of each colour channel. The picture says
/// itself how bright it is beside the frame's sides; black level and dark current are taken to be
/// small. nullopt if the colour camera does not see the whole frame.
std::optional<Eigen::MatrixXd> RgbdInformation(const FrameState& frame,
                                               const RgbdCalibration& cameras,
                                               const ColorCameraOptions& options,
                                               const cv::Mat3b& color, const DepthMatrix& depth);

/// The bound on the centroid's covariance [m²]; nullopt where there is none: without a return from
/// depth, a frame of unknown size may be anywhere along its line of sight.
std::optional<Eigen::Matrix3d> RgbdBound(const Eigen::MatrixXd& information,
                                         const PriorKnowledge& knowledge);

}  // namespace fenestra
