#include "experiments/trial_files/trial_files.h"

#include <fmt/format.h>

#include <cmath>

#include "core/detection/observation.h"
#include "core/geometry/calibration.h"
#include "core/io/image_io.h"
#include "core/io/temporary_files.h"
#include "experiments/output/file_formats.h"
#include "experiments/trial_files/trial_drawing.h"
#include "experiments/trial_files/truth_files.h"

namespace fenestra {
namespace {

std::vector<Eigen::Vector3f> CloudOf(const cv::Mat1f& depth_m, const CameraModel& camera) {
  std::vector<Eigen::Vector3f> points;
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const float z_m = depth_m(v, u);
      if (!std::isfinite(z_m) || z_m <= 0.0f) continue;
      if (const auto ray = camera.UnprojectRay({u, v})) points.push_back(ray->cast<float>() * z_m);
    }
  }
  return points;
}

cv::Mat1f ToMetres(const DepthImage& depth) {
  cv::Mat1f depth_m;
  depth.raw.convertTo(depth_m, CV_32F, depth.unit_m);
  return depth_m;
}

const CameraModel& ScoredCamera(const SensorCalibration& calibration) {
  const auto* stereo = std::get_if<StereoCalibration>(&calibration);
  return stereo != nullptr ? stereo->left : std::get<RgbdCalibration>(calibration).depth;
}

// As they truly are, the scored one first.
std::array<NamedCamera, 2> CamerasOf(const SensorCalibration& sensor, const GroundTruth& truth) {
  const Pose& X_WC = truth.X_WC;
  if (const auto* stereo = std::get_if<StereoCalibration>(&sensor)) {
    return {NamedCamera{"left", stereo->left, X_WC},
            NamedCamera{"right", stereo->right, X_WC * stereo->X_RL.inverse()}};
  }
  const auto& rgbd = std::get<RgbdCalibration>(sensor);
  return {NamedCamera{"depth", rgbd.depth, X_WC},
          NamedCamera{"color", rgbd.color, X_WC * rgbd.X_KD.inverse()}};
}

std::string FactorYaml(const TrialSettings& settings) {
  std::string yaml;
  for (const ParameterInfo& info : Factors().infos()) {
    yaml += fmt::format("{}: {}\n", info.name, ToString(Factors().Get(settings, info.name)));
  }
  return yaml;
}

}  // namespace

void WritePictures(const OutputPath& folder, const Observation& observation,
                   const SensorCalibration& calibration, const GroundTruth* truth,
                   const WindowEstimate* estimate, const StageLog& log) {
  const auto write = [&](const std::string& name, const cv::Mat& image,
                         std::span<const PictureView> views) {
    WritePng(folder / (name + ".png"), DrawTruthAndEstimate(image, views, truth, estimate));
  };
  const std::array<PictureView, 2> views = ObservationViews(calibration);
  if (const auto* stereo = std::get_if<StereoObservation>(&observation)) {
    write("left", stereo->left, {&views[0], 1});
    write("right", stereo->right, {&views[1], 1});
  } else {
    const auto& rgbd = std::get<RgbdObservation>(observation);
    write("color", rgbd.color, {&views[0], 1});
    write("depth", DrawDepth(rgbd.depth), {&views[1], 1});
  }
  int number = 0;
  for (const StagePicture& picture : log.pictures()) {
    write(fmt::format("{}_{}", ++number, picture.name), picture.image, picture.views);
  }
  for (const StageCloud& cloud : log.clouds()) {
    WriteFileAtomically(folder / (cloud.name + ".pcd"), ToPcd(cloud.points_C));
  }
}

void WritePictures(const OutputPath& folder, const FinishedTrial& trial) {
  for (const Attempt& attempt : trial.attempts) {
    const auto& estimate = attempt.record.score.estimate;
    WritePictures(folder / attempt.record.detector, trial.simulated.observation,
                  trial.simulated.calibration, &trial.simulated.truth,
                  estimate ? &*estimate : nullptr, attempt.log);
  }
}

void WriteObservationFiles(const OutputPath& folder, const SimulatedTrial& simulated) {
  WriteObservation(folder, simulated.observation, simulated.calibration);
  if (const auto* rgbd = std::get_if<RgbdObservation>(&simulated.observation)) {
    const CameraModel& camera = ScoredCamera(simulated.calibration);
    WriteFileAtomically(folder / "cloud.pcd", ToPcd(CloudOf(ToMetres(rgbd->depth), camera)));
  }
}

void WriteTruthFiles(const OutputPath& folder, const TrialRunner& runner,
                     const SimulatedTrial& simulated) {
  const TruthImages images = runner.TruthOf(simulated);
  const SensorCalibration sensor = runner.SensorOf(simulated).cameras;
  const bool stereo = std::holds_alternative<StereoCalibration>(sensor);
  if (const std::optional<ExplainedDepth> depth = runner.DepthOf(simulated)) {
    WritePng(folder / "no_return.png", DrawNoReturn(depth->no_return));
    // Ten bits at the upper end of sixteen, so that a viewer shows them.
    constexpr double kToSixteenBits = 64.0;
    if (!depth->infrared.empty()) {
      WritePng(folder / "infrared.png", cv::Mat1w(depth->infrared * kToSixteenBits));
    }
  }
  const GroundTruth& truth = simulated.truth;
  std::optional<double> visible;
  if (truth.target) {
    visible =
        VisibleShare(images, *truth.target, simulated.trial.settings.facade.window.frame_width_m);
  }
  WriteFileAtomically(folder / "truth.json", TruthJson(truth, CamerasOf(sensor, truth), visible));
  WriteFileAtomically(folder / "calibration.yaml",
                      std::visit([](const auto& told) { return ToOpenCvYaml(told); }, sensor));
  WriteTruthExr(folder / "truth.exr", images, stereo ? "right" : "projector");
  WriteFileAtomically(folder / "cloud.pcd", ToPcd(CloudOf(images.aovs.depth_m, images.camera)));
  WriteFileAtomically(folder / "trial.yaml", FactorYaml(simulated.trial.settings));
}

void WriteTrialFiles(const OutputPath& folder, const TrialRunner& runner,
                     const SimulatedTrial& simulated) {
  WriteObservationFiles(folder, simulated);
  WriteTruthFiles(folder / "truth", runner, simulated);
}

}  // namespace fenestra
