#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "core/detection/detector.h"
#include "core/geometry/calibration.h"
#include "experiments/trial/calibration_cache.h"
#include "experiments/trial/detector_maker.h"
#include "experiments/trial/trial_runner.h"
#include "renderers/ray_caster.h"
#include "sim/stereo/stereo_rig.h"
#include "sim/structured_light/structured_light_sensor.h"

namespace fenestra {

/// Everything that the trials of one cell share, made once: the scene with its ray tracing
/// structures, the sensor, the detectors. What a study draws in every trial is made in every trial.
class CellRunner final : public TrialRunner {
 public:
  /// Keeps no references. Runners that share `detectors` share running programs, too.
  CellRunner(const Study& study, const Cell& cell,
             std::shared_ptr<DetectorMaker> detectors = std::make_shared<DetectorMaker>());

  const Cell& cell() const override { return cell_; }
  const std::vector<DetectorChoice>& detectors() const override { return detector_choices_; }
  SimulatedTrial Simulate(int trial_index) const override;
  Attempt Try(size_t detector, const SimulatedTrial& simulated, bool keep_artifacts) const override;
  TrueSensor SensorOf(const SimulatedTrial& simulated) const override;
  TruthImages TruthOf(const SimulatedTrial& simulated) const override;
  std::optional<ExplainedDepth> DepthOf(const SimulatedTrial& simulated) const override;

 private:
  /// A scene and its ray tracing structures; fixed in memory.
  struct World {
    explicit World(const TrialSettings& settings);
    Scene scene;
    RayCaster caster;
  };
  /// A sensor and the calibration that detectors are given.
  struct Instrument {
    std::variant<StereoRig, StructuredLightSensor> sensor;
    SensorCalibration calibration;
    /// Of the calibration's error; see PriorKnowledge.
    std::optional<Eigen::MatrixXd> calibration_covariance;
    std::optional<DepthTheory> depth_theory;  ///< For a structured-light sensor.
  };

  Instrument MakeInstrument(const TrialSettings& settings, const TrialStreams& streams) const;
  std::shared_ptr<const World> WorldOf(const TrialSettings& settings) const;
  std::shared_ptr<const Instrument> InstrumentOf(const Trial& trial) const;

  Cell cell_;
  TrialSampler sampler_;
  std::vector<DetectorChoice> detector_choices_;
  std::shared_ptr<DetectorMaker> maker_;
  CalibrationCache cache_ = CalibrationCache::OfUser();
  std::shared_ptr<const World> shared_world_;            ///< Null if trials draw the scene.
  std::shared_ptr<const Instrument> shared_instrument_;  ///< Null if trials draw the sensor.
  /// As designed; none for a stereo rig, or if trials draw the design.
  std::optional<StructuredLightSensor> shared_design_;
  /// Empty if trials draw the calibration.
  std::vector<std::unique_ptr<Detector>> shared_detectors_;
};

}  // namespace fenestra
