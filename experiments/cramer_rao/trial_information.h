#pragma once

#include <Eigen/Core>
#include <optional>

#include "experiments/cramer_rao/depth_information.h"
#include "experiments/cramer_rao/prior_knowledge.h"
#include "experiments/study/study.h"
#include "sim/stereo/stereo_rig.h"
#include "sim/structured_light/structured_light_sensor.h"
#include "sim/truth/ground_truth.h"

namespace fenestra {

/// The information that the observation of one trial has on its target, from which the bound for
/// every detector follows. See docs/theory.md.
struct TrialInformation {
  SensorKind sensor;
  Eigen::MatrixXd fisher;  ///< Unknowns as in StereoInformation or RgbdInformation.
  /// Covariance of the nominal calibration's error; nullopt: it is the truth.
  std::optional<PairMatrix> calibration;
};

/// nullopt without a target that is wholly in view. border_m: width of the target's frame, seen
/// from the front.
std::optional<TrialInformation> InformationOf(const StereoRig& rig, const StereoShot& shot,
                                              const GroundTruth& truth, double border_m,
                                              const std::optional<PairMatrix>& calibration);

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
                                              const Pose& X_WB);

/// The bound on the covariance of p_CO for an unbiased estimate with this knowledge [m²]; nullopt
/// if the observation does not determine the centroid.
std::optional<Eigen::Matrix3d> BoundOf(const TrialInformation& information,
                                       const PriorKnowledge& knowledge);

/// A detector's prior knowledge: the calibration that the trial gives it, and the size that it
/// expects, if its options expected_width_m and expected_size_sigma_m say so.
PriorKnowledge PriorKnowledgeOf(const DetectorChoice& detector,
                                const TrialInformation& information);

}  // namespace fenestra
