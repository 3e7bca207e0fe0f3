#include "experiments/cell_bench.h"

#include <exception>

#include "experiments/scoring.h"
#include "experiments/trial_scene.h"

namespace fenestra {
namespace {

SensorCalibration NominalOf(const StereoRig& rig) {
  return rig.nominal();
}
SensorCalibration NominalOf(const StructuredLightSensor& sensor) {
  return sensor.nominal();
}

}  // namespace

CellBench::World::World(const TrialSettings& settings)
    : scene(MakeScene(settings)), caster(scene) {}

CellBench::CellBench(const Study& study, const Cell& cell)
    : study_(study), cell_(cell), detector_choices_(DetectorsOf(study, cell)) {
  bool scene_is_drawn = false;
  bool sensor_is_drawn = false;
  for (const auto& [name, distribution] : DrawnFactors(study, cell)) {
    const FactorGroup group = GroupOf(name);
    scene_is_drawn |= group == FactorGroup::kScene || group == FactorGroup::kFacade;
    sensor_is_drawn |= group == FactorGroup::kStereo || group == FactorGroup::kRgbd;
  }
  if (!scene_is_drawn) shared_world_ = std::make_shared<const World>(cell.settings);
  if (!sensor_is_drawn) {
    shared_sensor_ = std::make_shared<const Sensor>(MakeSensor(cell.settings, cell.sensor));
    const SensorCalibration calibration =
        std::visit([](const auto& sensor) { return NominalOf(sensor); }, *shared_sensor_);
    for (const DetectorChoice& choice : detector_choices_) {
      shared_detectors_.push_back(MakeDetector(choice.name, calibration, choice.options));
    }
  }
}

CellBench::Sensor CellBench::MakeSensor(const TrialSettings& settings, SensorKind kind) {
  if (kind == SensorKind::kStereo) return StereoRig(settings.stereo);
  return StructuredLightSensor(settings.rgbd);
}

std::shared_ptr<const CellBench::World> CellBench::WorldOf(const TrialSettings& settings) const {
  return shared_world_ ? shared_world_ : std::make_shared<const World>(settings);
}

std::shared_ptr<const CellBench::Sensor> CellBench::SensorOf(const TrialSettings& settings) const {
  if (shared_sensor_) return shared_sensor_;
  return std::make_shared<const Sensor>(MakeSensor(settings, cell_.sensor));
}

SimulatedTrial CellBench::Simulate(int trial_index) const {
  Trial trial = SampleTrial(study_, cell_, trial_index);
  const TrialSettings& settings = trial.settings;
  const auto world = WorldOf(settings);
  const auto sensor = SensorOf(settings);
  const Pose X_WB = RigPoseOf(settings, world->scene);
  const RandomStream shot = trial.stream.Child("shot");

  if (const auto* rig = std::get_if<StereoRig>(sensor.get())) {
    const StereoRig::TrueState state = rig->Draw(trial.stream.Child("rig"));
    return {.trial = trial,
            .calibration = rig->nominal(),
            .observation = rig->Observe(world->caster, settings.lighting, X_WB, state, shot),
            .truth = rig->Truth(world->scene, X_WB, state)};
  }
  const auto& rgbd = std::get<StructuredLightSensor>(*sensor);
  return {.trial = trial,
          .calibration = rgbd.nominal(),
          .observation = rgbd.Observe(world->caster, settings.lighting, X_WB, shot),
          .truth = rgbd.Truth(world->scene, X_WB)};
}

Attempt CellBench::Try(size_t detector, const SimulatedTrial& simulated,
                       bool keep_artifacts) const {
  const DetectorChoice& choice = detector_choices_[detector];
  StageLog log(SteadyClock(), keep_artifacts);
  std::variant<Detection, Crash> outcome = Crash{};
  try {
    std::unique_ptr<Detector> own;
    if (shared_detectors_.empty()) {
      own = MakeDetector(choice.name, simulated.calibration, choice.options);
    }
    const Detector& tested = own ? *own : *shared_detectors_[detector];
    outcome = tested.Detect(simulated.observation, log);
  } catch (const std::exception& error) {
    outcome = Crash{"exception", error.what()};
  } catch (...) {
    outcome = Crash{"exception", "of a type that is not std::exception"};
  }
  log.End();
  TrialRecord record{.cell = cell_.index,
                     .trial = simulated.trial.index,
                     .part = cell_.part,
                     .sensor = cell_.sensor,
                     .detector = choice.label,
                     .levels = cell_.levels,
                     .drawn = simulated.trial.drawn,
                     .score = ScoreDetection(outcome, simulated.truth),
                     .stages = log.times()};
  return {std::move(record), std::move(log)};
}

TruthImages CellBench::TruthOf(const SimulatedTrial& simulated) const {
  const TrialSettings& settings = simulated.trial.settings;
  const auto world = WorldOf(settings);
  const auto sensor = SensorOf(settings);
  const Pose X_WB = RigPoseOf(settings, world->scene);
  if (const auto* rig = std::get_if<StereoRig>(sensor.get())) {
    const StereoRig::TrueState state = rig->Draw(simulated.trial.stream.Child("rig"));
    return rig->LeftTruth(world->caster, settings.lighting, X_WB, state);
  }
  return std::get<StructuredLightSensor>(*sensor).DepthTruth(world->caster, settings.lighting,
                                                             X_WB);
}

}  // namespace fenestra
