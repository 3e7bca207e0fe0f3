#include "experiments/trial/cell_runner.h"

#include "experiments/trial/calibrated_rig.h"
#include "experiments/trial/scoring.h"

namespace fenestra {
namespace {

// The painted target is in the wall's face.
TargetOptions TargetOf(const TrialSettings& settings) {
  const WindowOptions& window = settings.facade.window;
  return {.border_m = window.frame_width_m,
          .setback_m = settings.scene == kFacadeScene ? window.setback_m : 0.0};
}

}  // namespace

CellRunner::World::World(const TrialSettings& settings)
    : scene(MakeScene(settings)), caster(scene) {}

CellRunner::CellRunner(const Study& study, const Cell& cell,
                       std::shared_ptr<DetectorMaker> detectors)
    : cell_(cell),
      sampler_(study, cell),
      detector_choices_(DetectorsOf(study, cell)),
      maker_(std::move(detectors)) {
  bool scene_is_drawn = false;
  bool sensor_is_drawn = false;
  for (const auto& [name, distribution] : DrawnFactors(study, cell)) {
    const FactorGroup group = GroupOf(name);
    scene_is_drawn |= group == FactorGroup::kScene || group == FactorGroup::kFacade;
    sensor_is_drawn |= group == FactorGroup::kStereo || group == FactorGroup::kRgbd;
  }
  if (!scene_is_drawn) shared_world_ = std::make_shared<const World>(cell.settings);
  const TrialSettings& settings = cell.settings;
  // All units of a design are told to be as designed: they share detectors.
  std::optional<SensorCalibration> calibration;
  if (cell.sensor == SensorKind::kRgbd && !sensor_is_drawn) {
    shared_design_.emplace(settings.rgbd);
    calibration = shared_design_->nominal();
  }
  sensor_is_drawn |= EachTrialHasItsOwnSensor(settings, cell.sensor);
  if (!sensor_is_drawn) {
    shared_instrument_ =
        std::make_shared<const Instrument>(MakeInstrument(settings, SharedStreams(study, cell)));
    calibration = shared_instrument_->calibration;
  }
  if (!calibration) return;
  for (const DetectorChoice& choice : detector_choices_) {
    shared_detectors_.push_back(maker_->Make(choice, *calibration));
  }
}

CellRunner::Instrument CellRunner::MakeInstrument(const TrialSettings& settings,
                                                  const TrialStreams& streams) const {
  if (cell_.sensor == SensorKind::kRgbd) {
    const UnitDeviations deviations = settings.rgbd_calibration.deviations();
    StructuredLightSensor sensor =
        (shared_design_ ? *shared_design_ : StructuredLightSensor(settings.rgbd))
            .Unit(deviations, streams.rig);
    const RgbdCalibration calibration = sensor.nominal();
    const DepthTheory theory(sensor);
    std::optional<Eigen::MatrixXd> covariance;
    if (settings.rgbd_calibration.source != RgbdCalibrationSource::kExact) {
      covariance = UnitCovariance(DesignOf(settings.rgbd), deviations);
    }
    return {.sensor = std::move(sensor),
            .calibration = calibration,
            .calibration_covariance = covariance,
            .depth_theory = theory};
  }
  const StereoRig built(settings.stereo, streams.rig);
  CalibratedRig calibrated =
      Calibrated(built, settings.stereo_calibration, streams.calibration, cache_);
  Instrument instrument{.sensor = std::move(calibrated.rig),
                        .calibration = calibrated.nominal,
                        .calibration_covariance = {},
                        .depth_theory = {}};
  if (calibrated.covariance) instrument.calibration_covariance = *calibrated.covariance;
  return instrument;
}

std::shared_ptr<const CellRunner::World> CellRunner::WorldOf(const TrialSettings& settings) const {
  return shared_world_ ? shared_world_ : std::make_shared<const World>(settings);
}

std::shared_ptr<const CellRunner::Instrument> CellRunner::InstrumentOf(const Trial& trial) const {
  if (shared_instrument_) return shared_instrument_;
  return std::make_shared<const Instrument>(MakeInstrument(trial.settings, trial.streams));
}

SimulatedTrial CellRunner::Simulate(int trial_index) const {
  Trial trial = sampler_.Sample(trial_index);
  const TrialSettings& settings = trial.settings;
  const auto world = WorldOf(settings);
  const auto instrument = InstrumentOf(trial);
  const Pose X_WB = RigPoseOf(settings, world->scene);
  const RandomStream& shot = trial.streams.shot;
  SimulatedTrial simulated{.trial = trial,
                           .calibration = instrument->calibration,
                           .observation = {},
                           .truth = {},
                           .information = {}};
  if (const auto* rig = std::get_if<StereoRig>(&instrument->sensor)) {
    const StereoShot seen = rig->Shoot(world->caster, settings.lighting, X_WB, shot);
    simulated.observation = seen.observation;
    simulated.truth = rig->Truth(world->scene, X_WB);
    simulated.information = InformationOf(*rig, seen, simulated.truth, TargetOf(settings).border_m,
                                          instrument->calibration_covariance);
    return simulated;
  }
  const auto& sensor = std::get<StructuredLightSensor>(instrument->sensor);
  const RgbdObservation seen = sensor.Observe(world->caster, settings.lighting, X_WB, shot);
  simulated.observation = seen;
  simulated.truth = sensor.Truth(world->scene, X_WB);
  simulated.information =
      InformationOf(sensor, *instrument->depth_theory, seen, simulated.truth, TargetOf(settings),
                    world->caster, settings.lighting, X_WB, instrument->calibration_covariance);
  return simulated;
}

Attempt CellRunner::Try(size_t detector, const SimulatedTrial& simulated,
                        bool keep_artifacts) const {
  const DetectorChoice& choice = detector_choices_[detector];
  StageLog log(SteadyClock(), keep_artifacts);
  const auto detect = [&] {
    std::unique_ptr<Detector> own;
    if (shared_detectors_.empty()) own = maker_->Make(choice, simulated.calibration);
    const Detector& tested = own ? *own : *shared_detectors_[detector];
    return tested.Detect(simulated.observation, log);
  };
  const std::variant<Detection, Crash> outcome =
      DetectionOrCrash(detect, DetectorMaker::IsOwn(choice));
  log.End();
  TrialRecord record{.cell = cell_.index,
                     .trial = simulated.trial.index,
                     .part = cell_.part,
                     .sensor = cell_.sensor,
                     .detector = choice.label,
                     .levels = cell_.levels,
                     .drawn = simulated.trial.drawn,
                     .score = ScoreDetection(outcome, simulated.truth),
                     .bound_C = {},
                     .stages = log.times()};
  if (const auto& information = simulated.information) {
    record.bound_C = BoundOf(*information, PriorKnowledgeOf(choice, *information));
  }
  return {std::move(record), std::move(log)};
}

std::optional<ExplainedDepth> CellRunner::DepthOf(const SimulatedTrial& simulated) const {
  const auto instrument = InstrumentOf(simulated.trial);
  const auto* sensor = std::get_if<StructuredLightSensor>(&instrument->sensor);
  if (sensor == nullptr) return std::nullopt;
  const TrialSettings& settings = simulated.trial.settings;
  const auto world = WorldOf(settings);
  return sensor->ObserveDepth(world->caster, settings.lighting, RigPoseOf(settings, world->scene),
                              simulated.trial.streams.shot);
}

TrueSensor CellRunner::SensorOf(const SimulatedTrial& simulated) const {
  const auto instrument = InstrumentOf(simulated.trial);
  const auto sensor = [&](const SensorCalibration& cameras, const Pose& X_BC,
                          const RigMotion& motion) -> TrueSensor {
    const Eigen::Matrix3d R_WB = (simulated.truth.X_WC * X_BC.inverse()).rotation();
    const Eigen::Vector3d turning_B = motion.angular_velocity_B.cross(X_BC.translation());
    return {.cameras = cameras, .velocity_W = R_WB * (motion.velocity_B + turning_B)};
  };
  if (const auto* rig = std::get_if<StereoRig>(&instrument->sensor)) {
    return sensor(rig->cameras(), rig->X_BL(), rig->MotionDuring(simulated.trial.streams.shot));
  }
  const auto& rgbd = std::get<StructuredLightSensor>(instrument->sensor);
  return sensor(rgbd.cameras(), rgbd.X_WD(Pose()), rgbd.options().motion);
}

TruthImages CellRunner::TruthOf(const SimulatedTrial& simulated) const {
  const TrialSettings& settings = simulated.trial.settings;
  const auto world = WorldOf(settings);
  const auto instrument = InstrumentOf(simulated.trial);
  const Pose X_WB = RigPoseOf(settings, world->scene);
  return std::visit(
      [&](const auto& sensor) { return sensor.PixelTruth(world->caster, settings.lighting, X_WB); },
      instrument->sensor);
}

}  // namespace fenestra
