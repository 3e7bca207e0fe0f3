#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "core/geometry/calibration.h"
#include "experiments/cramer_rao/frame_state.h"
#include "experiments/cramer_rao/pixel_noise.h"
#include "experiments/cramer_rao/prior_knowledge.h"
#include "sim/camera/lens.h"

namespace fenestra {

/// The pixels of a pair as they would be without noise, and their noise.
struct StereoPictures {
  StereoCalibration cameras;  ///< As they truly are.
  cv::Mat1f left_e;           ///< Photo-electrons of the exposure.
  cv::Mat1f right_e;
  PixelNoise noise;
  PointSpread spread;
};

/// Fisher information of a pair of pictures. Unknowns: those of the frame, in the left camera; the
/// 24 of the pair in PairVector's order; blur and levels of each picture. nullopt if a camera does
/// not see the whole frame.
std::optional<Eigen::MatrixXd> StereoInformation(const FrameState& frame,
                                                 const StereoPictures& pictures);

/// The bound on the centroid's covariance [m²]; nullopt where there is none.
std::optional<Eigen::Matrix3d> StereoBound(const Eigen::MatrixXd& information,
                                           const PriorKnowledge& knowledge);

}  // namespace fenestra
