#include "experiments/cramer_rao/trial_information.h"

#include "experiments/cramer_rao/rgbd_information.h"
#include "experiments/cramer_rao/stereo_information.h"

namespace fenestra {
namespace {

std::optional<double> NumberOption(const DetectorChoice& detector, const char* name) {
  const auto option = detector.options.find(name);
  if (option == detector.options.end()) return std::nullopt;
  const double* number = std::get_if<double>(&option->second);
  return number != nullptr ? std::optional(*number) : std::nullopt;
}

}  // namespace

std::optional<TrialInformation> InformationOf(const StereoRig& rig, const StereoShot& shot,
                                              const GroundTruth& truth, double border_m,
                                              const std::optional<PairMatrix>& calibration) {
  if (!truth.target || !truth.in_view) return std::nullopt;
  const StereoRigOptions& options = rig.options();
  const auto fisher =
      StereoInformation(FrameState::Of(*truth.target, border_m),
                        {.cameras = rig.cameras(),
                         .left_e = shot.left_e,
                         .right_e = shot.right_e,
                         .noise = PixelNoise::Linear(options.sensor, shot.exposure),
                         .spread = {.centre_sigma_px = options.lens.blur_sigma_px,
                                    .corner_sigma_px = options.lens.corner_blur_sigma_px}});
  if (!fisher) return std::nullopt;
  return TrialInformation{SensorKind::kStereo, *fisher, calibration};
}

std::optional<TrialInformation> InformationOf(const StructuredLightSensor& sensor,
                                              const DepthTheory& theory,
                                              const RgbdObservation& observation,
                                              const GroundTruth& truth, const TargetOptions& target,
                                              const RayCaster& caster, const Lighting& lighting,
                                              const Pose& X_WB) {
  if (!truth.target || !truth.in_view) return std::nullopt;
  const FrameState frame = FrameState::Of(*truth.target, target.border_m);
  const DepthMatrix depth =
      theory.Information(frame, target.setback_m, observation.depth, caster, lighting, X_WB);
  const auto fisher =
      RgbdInformation(frame, sensor.nominal(), sensor.options().color, observation.color, depth);
  if (!fisher) return std::nullopt;
  return TrialInformation{SensorKind::kRgbd, *fisher, {}};
}

std::optional<Eigen::Matrix3d> BoundOf(const TrialInformation& information,
                                       const PriorKnowledge& knowledge) {
  return information.sensor == SensorKind::kStereo ? StereoBound(information.fisher, knowledge)
                                                   : RgbdBound(information.fisher, knowledge);
}

PriorKnowledge PriorKnowledgeOf(const DetectorChoice& detector,
                                const TrialInformation& information) {
  PriorKnowledge knowledge{.size_sigma_m = {}, .calibration = information.calibration};
  const auto expected_m = NumberOption(detector, "expected_width_m");
  if (expected_m && *expected_m > 0.0) {
    knowledge.size_sigma_m = NumberOption(detector, "expected_size_sigma_m");
  }
  return knowledge;
}

}  // namespace fenestra
