#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "core/geometry/calibration.h"
#include "experiments/cramer_rao/cramer_rao.h"
#include "experiments/cramer_rao/depth_information.h"
#include "experiments/cramer_rao/pixel_noise.h"
#include "experiments/study/study.h"
#include "sim/camera/color_camera.h"
#include "sim/camera/point_spread.h"
#include "sim/stereo/stereo_rig.h"
#include "sim/structured_light/structured_light_sensor.h"
#include "sim/truth/ground_truth.h"

namespace fenestra {

/// The pixels of one picture as they would be without noise, and their noise.
struct StereoPicture {
  cv::Mat1f electrons;  ///< Photo-electrons of the exposure.
  PixelNoise noise;
  PointSpread spread;
};

struct StereoPictures {
  StereoCalibration cameras;  ///< As they truly are.
  StereoPicture left;
  StereoPicture right;
};

/// Fisher information of a pair of pictures. Unknowns: those of the frame, in the left camera; the
/// 24 of the pair in PairVector's order; blur and levels of each picture. nullopt if a camera does
/// not see the whole frame.
std::optional<Eigen::MatrixXd> StereoInformation(const FrameState& frame,
                                                 const StereoPictures& pictures);

/// The bound on the centroid's covariance [m²]; nullopt where there is none.
std::optional<Eigen::Matrix3d> StereoBound(const Eigen::MatrixXd& information,
                                           const PriorKnowledge& knowledge);

/// Fisher information of a colour and a depth image. Unknowns: those of DepthMatrix, in the camera
/// of the depth image's pixels, and blur and levels of each colour channel. The picture says
/// itself how bright it is beside the frame's sides; black level and dark current are taken to be
/// small. nullopt if the colour camera does not see the whole frame.
std::optional<Eigen::MatrixXd> RgbdInformation(const FrameState& frame,
                                               const StructuredLightSensor& sensor,
                                               const cv::Mat3b& color, const DepthMatrix& depth);

/// The bound on the centroid's covariance [m²]; nullopt where there is none: without a return from
/// depth, a frame of unknown size may be anywhere along its line of sight.
std::optional<Eigen::Matrix3d> RgbdBound(const Eigen::MatrixXd& information,
                                         const PriorKnowledge& knowledge);

/// The information that the observation of one trial has on its target, from which the bound for
/// every detector follows. See docs/theory.md.
struct TrialInformation {
  SensorKind sensor;
  Eigen::MatrixXd fisher;  ///< Unknowns as in StereoInformation or RgbdInformation.
  /// Covariance of the nominal calibration's error, see PriorKnowledge; nullopt: it is the truth.
  std::optional<Eigen::MatrixXd> calibration;
};

/// nullopt without a target that is wholly in view. border_m: width of the target's frame, seen
/// from the front.
std::optional<TrialInformation> InformationOf(const StereoRig& rig, const StereoShot& shot,
                                              const GroundTruth& truth, double border_m,
                                              const std::optional<Eigen::MatrixXd>& calibration);

/// The target in its wall, as the scene has it.
struct TargetOptions {
  double border_m;   ///< Width of the frame, seen from the front.
  double setback_m;  ///< Front of the frame behind the wall's face.
};

/// The information of an RGB-D observation that the sensor made at X_WB.
std::optional<TrialInformation> InformationOf(const StructuredLightSensor& sensor,
                                              const DepthTheory& theory,
                                              const RgbdObservation& observation,
                                              const GroundTruth& truth, const TargetOptions& target,
                                              const RayCaster& caster, const Lighting& lighting,
                                              const Pose& X_WB,
                                              const std::optional<Eigen::MatrixXd>& calibration);

/// The bound on the covariance of p_CO for an unbiased estimate with this knowledge [m²]; nullopt
/// if the observation does not determine the centroid.
std::optional<Eigen::Matrix3d> BoundOf(const TrialInformation& information,
                                       const PriorKnowledge& knowledge);

/// A detector's prior knowledge: the calibration that the trial gives it, and the size that it
/// expects, if its options expected_width_m and expected_size_sigma_m say so.
PriorKnowledge PriorKnowledgeOf(const DetectorChoice& detector,
                                const TrialInformation& information);

}  // namespace fenestra
