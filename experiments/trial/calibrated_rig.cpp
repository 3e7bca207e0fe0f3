#include "experiments/trial/calibrated_rig.h"

#include <fmt/format.h>

#include "core/geometry/calibration.h"
#include "core/geometry/pose.h"
#include "core/io/input_error.h"
#include "core/random/random_stream.h"
#include "core/system/check.h"
#include "experiments/study/factors.h"
#include "experiments/trial/board_theory.h"
#include "sim/camera/built_camera.h"

namespace fenestra {
namespace {

BoardSessionOptions SessionOf(const CalibrationChoice& choice) {
  BoardSessionOptions session;
  session.board.kind = choice.board;
  session.tolerances = choice.board_tolerances;
  session.views = choice.boards;
  return session;
}

// What boards leave, to first order, for a rig of this design.
Eigen::MatrixXd ErrorsOfBoards(const StereoRig& rig, const CalibrationChoice& choice) {
  return BoardErrors(DesignOf(rig.options()), SessionOf(choice), choice.corner_noise_px,
                     {.free_k3 = choice.free_k3});
}

StereoCalibration Perturbed(const StereoRig& rig, const CalibrationChoice& choice,
                            const Eigen::MatrixXd& errors, const RandomStream& stream) {
  const RandomStream boards = stream.Child("boards");
  Eigen::VectorXd normals(errors.cols());
  for (Eigen::Index i = 0; i < normals.size(); ++i) {
    normals[i] = boards.Normal(static_cast<uint64_t>(i));
  }
  StereoCalibration nominal = WithError(rig.cameras(), errors * normals);
  const Pose drift = RandomPose(stream, choice.rotation_error_rad, choice.translation_error_m);
  nominal.X_RL = drift * nominal.X_RL;
  return nominal;
}

CalibrationWithCovariance WithBoards(const StereoRig& rig, const CalibrationChoice& choice,
                                     const RandomStream& stream, const CalibrationCache& cache) {
  const BoardSessionOptions session = SessionOf(choice);
  // A study that leaves the noise out of its pictures asks what the calibration alone does: the
  // pictures of the boards have theirs.
  const StereoRig noisy = rig.WithNoise();
  const auto calibrate = [&] {
    const StereoCalibrationResult result =
        CalibrateWithBoards(noisy, session, {.free_k3 = choice.free_k3}, stream);
    return CalibrationWithCovariance{result.calibration, result.covariance};
  };
  return cache.Get(ContentOf(noisy, choice, stream), calibrate);
}

constexpr int kTurn = 2 * kCameraParameters;

// Of a right camera that is turned and shifted.
PairMatrix MovedRight(const Eigen::Vector3d& p_RL, double turn_rad, double shift_m) {
  PairMatrix covariance = PairMatrix::Zero();
  covariance.block<6, 6>(kTurn, kTurn) = MovedCovariance(p_RL, turn_rad, shift_m);
  return covariance;
}

// What boards leave with these errors (ErrorsOfBoards), and drift since then.
PairMatrix PerturbedCovariance(const Eigen::Vector3d& p_RL, const CalibrationChoice& choice,
                               const Eigen::MatrixXd& errors) {
  return errors * errors.transpose() +
         MovedRight(p_RL, choice.rotation_error_rad, choice.translation_error_m);
}

// The covariance of a rig that stands within its tolerances around its design.
PairMatrix OfTolerances(const StereoRigOptions& options) {
  PairMatrix covariance = PairMatrix::Zero();
  if (options.as_designed) return covariance;
  const RigTolerances& t = options.tolerances;
  const StereoCalibration design = DesignOf(options);
  for (const int camera : {0, kCameraParameters}) {
    covariance.block<kCameraParameters, kCameraParameters>(camera, camera) =
        BuiltCovariance(design.left, t.camera());
  }
  // Both cameras are turned and shifted; only the right one's turn moves the left camera in it.
  covariance += MovedRight(design.X_RL.translation(), t.rotation_rad, t.translation_m) +
                MovedRight(Eigen::Vector3d::Zero(), t.rotation_rad, t.translation_m);
  return covariance;
}

}  // namespace

CalibratedRig Calibrated(const StereoRig& rig, const CalibrationChoice& choice,
                         const RandomStream& calibration, const CalibrationCache& cache) {
  const auto with_covariance = [&choice](const StereoRig& flown, const StereoCalibration& nominal,
                                         const std::optional<PairMatrix>& boards = {}) {
    return CalibratedRig{flown, nominal, CalibrationCovariance(flown, choice, boards)};
  };
  const auto with_boards = [&](const StereoRig& flown) {
    const CalibrationWithCovariance measured =
        WithBoards(rig, choice, calibration.Child("boards"), cache);
    return with_covariance(flown, measured.calibration, measured.covariance);
  };
  switch (choice.source) {
    case CalibrationSource::kExact:
      return with_covariance(rig, rig.cameras());
    case CalibrationSource::kPerturbed: {
      const Eigen::MatrixXd errors = ErrorsOfBoards(rig, choice);
      return {rig, Perturbed(rig, choice, errors, calibration),
              PerturbedCovariance(rig.cameras().X_RL.translation(), choice, errors)};
    }
    case CalibrationSource::kBoards:
      return with_boards(rig);
    case CalibrationSource::kStale:
      return with_boards(rig.Displaced(RandomPose(
          calibration.Child("shake"), choice.shake_rotation_rad, choice.shake_translation_m)));
    case CalibrationSource::kDesign:
      return with_covariance(rig, DesignOf(rig.options()));
  }
  return with_covariance(rig, rig.cameras());
}

std::optional<PairMatrix> CalibrationCovariance(const StereoRig& rig,
                                                const CalibrationChoice& choice,
                                                const std::optional<PairMatrix>& boards) {
  const Eigen::Vector3d p_RL = rig.cameras().X_RL.translation();
  switch (choice.source) {
    case CalibrationSource::kExact:
      return std::nullopt;
    case CalibrationSource::kPerturbed:
      return PerturbedCovariance(p_RL, choice, ErrorsOfBoards(rig, choice));
    case CalibrationSource::kBoards:
      FENESTRA_CHECK(boards.has_value(), "a calibration with boards has a covariance");
      return boards;
    case CalibrationSource::kStale:
      FENESTRA_CHECK(boards.has_value(), "a calibration with boards has a covariance");
      return *boards + MovedRight(p_RL, choice.shake_rotation_rad, choice.shake_translation_m);
    case CalibrationSource::kDesign:
      return OfTolerances(rig.options());
  }
  FENESTRA_CHECK(false, "calibration source out of range");
}

StereoCalibrationResult CalibrateWithBoards(const StereoRig& rig,
                                            const BoardSessionOptions& session,
                                            const AdjustmentOptions& adjustment,
                                            const RandomStream& stream) {
  Validate(session);
  const BoardWorld world(BoardShape(session.board, session.tolerances, stream.Child("board")));
  std::vector<NamedView> views;
  for (int i = 0; i < session.views; ++i) {
    const RandomStream view = stream.Child("view", static_cast<uint64_t>(i));
    const StereoObservation seen = ShootBoard(rig, world, session, view);
    const BoardSighting left = FindBoard(seen.left, session.board);
    const BoardSighting right = FindBoard(seen.right, session.board);
    const auto corners = [](const BoardSighting& sighting) {
      const auto* found = std::get_if<std::vector<BoardCorner>>(&sighting);
      return found != nullptr ? *found : std::vector<BoardCorner>();
    };
    views.push_back({fmt::format("view {}", i), {corners(left), corners(right)}});
  }
  const cv::Size size(rig.options().width_px, rig.options().height_px);
  return CalibrateStereo(views, session.board,
                         {.left_size = size, .right_size = size, .adjustment = adjustment});
}

std::string ContentOf(const StereoRig& rig, const CalibrationChoice& choice,
                      const RandomStream& stream) {
  // What the boards do not see keeps its default: how the rig flies, and what comes after.
  TrialSettings settings;
  settings.stereo = rig.Still().options();
  settings.stereo_calibration.boards = choice.boards;
  settings.stereo_calibration.board = choice.board;
  settings.stereo_calibration.board_tolerances = choice.board_tolerances;
  settings.stereo_calibration.free_k3 = choice.free_k3;
  std::string content = ToOpenCvYaml(rig.cameras()) + fmt::format("rig {:016x} boards {:016x}\n",
                                                                  rig.pattern_key(), stream.key());
  for (const ParameterInfo& info : Factors().infos()) {
    if (GroupOf(info.name) != FactorGroup::kStereo) continue;
    content += fmt::format("{}: {}\n", info.name, ToString(Factors().Get(settings, info.name)));
  }
  return content;
}

}  // namespace fenestra
