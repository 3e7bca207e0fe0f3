#pragma once

#include <Eigen/Core>
#include <optional>

#include "experiments/study.h"
#include "experiments/theory/knowledge.h"
#include "sim/ground_truth.h"
#include "sim/stereo_rig.h"

namespace fenestra {

/// What the observation of one trial tells of its target, from which the bound for every detector
/// follows. See docs/theory.md.
struct TrialInformation {
  SensorKind sensor;
  Eigen::MatrixXd fisher;  ///< Unknowns as in StereoInformation.
  /// How far the calibration that detectors are told may be from the truth; nullopt: not at all.
  std::optional<PairMatrix> calibration;
};

/// nullopt without a target that is wholly in view. border_m: width of the target's frame, seen
/// from the front.
std::optional<TrialInformation> InformationOf(const StereoRig& rig, const StereoShot& shot,
                                              const GroundTruth& truth, double border_m,
                                              const std::optional<PairMatrix>& calibration);

/// The bound on the covariance of p_CO for an unbiased estimate with this knowledge [m²]; nullopt
/// if the observation does not determine the centroid.
std::optional<Eigen::Matrix3d> BoundOf(const TrialInformation& information,
                                       const Knowledge& knowledge);

/// What a detector knows: the calibration that the trial tells it, and the size that it expects, if
/// its options expected_width_m and expected_size_sigma_m say so.
Knowledge KnowledgeOf(const DetectorChoice& detector, const TrialInformation& information);

}  // namespace fenestra
