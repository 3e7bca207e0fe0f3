#pragma once

#include <optional>
#include <vector>

#include "core/geometry/calibration.h"
#include "experiments/cramer_rao/trial_information.h"
#include "experiments/sampling/trial_sampler.h"
#include "experiments/study/study.h"
#include "experiments/trial/trial_record.h"
#include "sim/structured_light/explained_depth.h"
#include "sim/truth/ground_truth.h"

namespace fenestra {

/// One trial up to the point where detectors take over.
struct SimulatedTrial {
  Trial trial;
  SensorCalibration calibration;  ///< The calibration that detectors are given.
  Observation observation;
  GroundTruth truth;
  /// The information of the observation on the target; nullopt where theory gives none.
  std::optional<TrialInformation> information{};
};

/// The sensor of a trial as it truly is; a calibration is an estimate of it.
struct TrueSensor {
  SensorCalibration cameras;
  Eigen::Vector3d velocity_W;  ///< Velocity of the scored camera's origin in the world [m/s].
};

/// One detector's attempt at a simulated trial.
struct Attempt {
  TrialRecord record;
  StageLog log;
};

/// Simulates the trials of one cell and tries detectors on them. Const calls are thread-safe and
/// single-threaded inside; a trial's result depends on the study, the cell and the trial's index
/// alone. CellRunner is the real one; tests and measurements of the harness put quick ones in its
/// place.
class TrialRunner {
 public:
  virtual ~TrialRunner() = default;

  virtual const Cell& cell() const = 0;
  virtual const std::vector<DetectorChoice>& detectors() const = 0;

  virtual SimulatedTrial Simulate(int trial_index) const = 0;

  /// Runs one detector on what it may see, then scores. A detector that throws is recorded as
  /// crashed.
  virtual Attempt Try(size_t detector, const SimulatedTrial& simulated,
                      bool keep_artifacts) const = 0;

  virtual TrueSensor SensorOf(const SimulatedTrial& simulated) const = 0;

  /// Per-pixel truth of the left (stereo) or depth camera.
  virtual TruthImages TruthOf(const SimulatedTrial& simulated) const = 0;

  /// The depth image with what detectors never see of it: why pixels have no return, and the
  /// infra-red image if there is one. nullopt for stereo.
  virtual std::optional<ExplainedDepth> DepthOf(const SimulatedTrial& simulated) const = 0;
};

/// A trial that every detector of its cell has tried.
struct FinishedTrial {
  const TrialRunner& runner;
  const SimulatedTrial& simulated;
  const std::vector<Attempt>& attempts;

  TrialKey key() const { return {runner.cell().index, simulated.trial.index}; }
  std::vector<TrialRecord> Records() const {
    std::vector<TrialRecord> records;
    for (const Attempt& attempt : attempts) records.push_back(attempt.record);
    return records;
  }
};

}  // namespace fenestra
