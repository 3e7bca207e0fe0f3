#pragma once

#include <memory>
#include <stdexcept>

#include "experiments/run/run_trials.h"
#include "experiments/sampling/trial_sampler.h"
#include "sim/stereo/stereo_rig.h"
#include "tests/experiments/trial/record_examples.h"

namespace fenestra::testing {

/// A runner whose sensor and detectors take no time: the trial is sampled as a real one, its images
/// have one pixel, and each detector's row follows from the trial's stream and the detector's
/// label, a hit with numbers in every field.
class MockRunner final : public TrialRunner {
 public:
  MockRunner(const Study& study, const Cell& cell)
      : study_(study), cell_(cell), detectors_(DetectorsOf(study, cell)) {}

  static std::shared_ptr<const TrialRunner> Make(const Study& study, const Cell& cell) {
    return std::make_shared<const MockRunner>(study, cell);
  }

  const Cell& cell() const override { return cell_; }
  const std::vector<DetectorChoice>& detectors() const override { return detectors_; }

  SimulatedTrial Simulate(int trial_index) const override {
    const cv::Mat1b pixel(1, 1, static_cast<uint8_t>(0));
    return {.trial = SampleTrial(study_, cell_, trial_index),
            .calibration = calibration_,
            .observation = StereoObservation{.left = pixel, .right = pixel},
            .truth = {}};
  }

  Attempt Try(size_t detector, const SimulatedTrial& simulated,
              bool /*keep_artifacts*/) const override {
    const std::string& label = detectors_[detector].label;
    const RandomStream stream = simulated.trial.streams.shot.Child("mock:" + label);
    const Eigen::Vector3d error_C(stream.Normal(0), stream.Normal(1), stream.Normal(2));
    TrialRecord row =
        RowWithError(cell_.index, simulated.trial.index, Outcome::kHit, 0.01 * error_C, label);
    row.part = cell_.part;
    row.sensor = cell_.sensor;
    row.levels = cell_.levels;
    row.drawn = simulated.trial.drawn;
    row.score.estimate->covariance_C = Eigen::Matrix3d::Constant(stream.Normal(3));
    row.stages = {{"rectify", 0.01}, {"match", 0.02}, {"edges", 0.003}, {"centroid", 1e-5}};
    return {std::move(row), StageLog(SteadyClock(), false)};
  }

  TrueSensor SensorOf(const SimulatedTrial& /*simulated*/) const override {
    return {.cameras = calibration_, .velocity_W = Eigen::Vector3d::Zero()};
  }

  std::optional<ExplainedDepth> DepthOf(const SimulatedTrial& /*simulated*/) const override {
    return std::nullopt;
  }

  TruthImages TruthOf(const SimulatedTrial& /*simulated*/) const override {
    throw std::logic_error("a mock has no truth images");
  }

 private:
  Study study_;
  Cell cell_;
  std::vector<DetectorChoice> detectors_;
  StereoCalibration calibration_ = DesignOf(StereoRigOptions());
};

}  // namespace fenestra::testing
