#include "sim/stereo/board_session.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/io/faults.h"
#include "core/io/input_error.h"
#include "scenes/targets/flat_targets.h"

namespace fenestra {
namespace {

// Free border around the board, as a share of the image's width.
constexpr double kSpare = 0.03;
constexpr uint64_t kMostDraws = 2000;

double Between(double low, double high, double u) {
  return low + (high - low) * u;
}

bool SeesBoard(const CameraModel& camera, const Pose& X_CG, const CalibrationBoard& board) {
  const double spare_px = kSpare * camera.width_px();
  for (const double x : {0.0, board.width_m()}) {
    for (const double y : {0.0, board.height_m()}) {
      const auto pixel = camera.Project(X_CG * Eigen::Vector3d(x, y, 0.0));
      if (!pixel || pixel->x() < spare_px || pixel->x() > camera.width_px() - spare_px ||
          pixel->y() < spare_px || pixel->y() > camera.height_px() - spare_px) {
        return false;
      }
    }
  }
  return true;
}

// A pose of the board that need not be in view; `draw` counts attempts.
Pose AnyBoardPose(const StereoCalibration& design, const BoardSessionOptions& session,
                  const RandomStream& view, uint64_t draw) {
  const RandomStream stream = view.Child("board_pose", draw);
  const CameraParameters& camera = design.left.parameters();
  const double share = Between(session.smallest_share, session.largest_share, stream.Uniform(0));
  const double z_m = camera.fx_px * session.board.width_m() / (share * camera.width_px);
  const double u_px = camera.width_px * stream.Uniform(1);
  const double v_px = camera.height_px * stream.Uniform(2);
  const Eigen::Vector3d p_LCentre((u_px - camera.cx_px) / camera.fx_px * z_m,
                                  (v_px - camera.cy_px) / camera.fy_px * z_m, z_m);
  const double tilt = session.largest_tilt_rad * stream.Uniform(3);
  const double axis = 2.0 * std::numbers::pi * stream.Uniform(4);
  const double roll = session.largest_roll_rad * Between(-1.0, 1.0, stream.Uniform(5));
  const Eigen::Matrix3d R_LG =
      RotationFromVector(tilt * Eigen::Vector3d(std::cos(axis), std::sin(axis), 0.0)) *
      RotationFromVector({0.0, 0.0, roll});
  const Eigen::Vector3d p_GCentre(0.5 * session.board.width_m(), 0.5 * session.board.height_m(),
                                  0.0);
  return Pose(R_LG, p_LCentre - R_LG * p_GCentre);
}

Pose BoardPoseInView(const StereoCalibration& design, const BoardSessionOptions& session,
                     const RandomStream& view) {
  const auto X_LG = DrawBoardPose(design, session, view);
  if (!X_LG) {
    throw InputError("calibration board",
                     fmt::format("the cameras have no place in common where a board of {:.3g} m x "
                                 "{:.3g} m fills {:.0f} to {:.0f} % of the image's width",
                                 session.board.width_m(), session.board.height_m(),
                                 100.0 * session.smallest_share, 100.0 * session.largest_share));
  }
  return *X_LG;
}

// Pose of a rig from which it sees the board where the design says.
Pose RigPoseFor(const StereoRig& rig, const BoardSessionOptions& session,
                const RandomStream& view) {
  const StereoCalibration design = DesignOf(rig.options());
  const Pose X_LG = BoardPoseInView(design, session, view);
  const Pose X_BL = Pose::Translation({-0.5 * rig.options().baseline_m, 0.0, 0.0});
  return BoardPose(session.board) * X_LG.inverse() * X_BL.inverse();
}

}  // namespace

void Validate(const BoardSessionOptions& o) {
  Validate(o.board);
  Validate(o.tolerances);
  Faults faults("calibration session");
  faults.Require(o.views >= 3, fmt::format("{} views are fewer than 3", o.views));
  faults.Require(o.illuminance_lx > 0.0, "the board must be lit");
  faults.Require(
      o.smallest_share > 0.0 && o.smallest_share <= o.largest_share && o.largest_share < 1.0,
      "the board's share of the image's width must lie between 0 and 1");
  faults.Require(o.largest_tilt_rad >= 0.0 && o.largest_tilt_rad < 1.5,
                 "the board's tilt must lie between 0 and 85 degrees");
  faults.ThrowIfAny();
}

BoardWorld::BoardWorld(const BoardShape& shape)
    : shape_(shape),
      caster_(std::make_unique<const RayCaster>(
          MakeBoardScene({.board = shape.board(), .shape = shape}))) {}

std::optional<Pose> DrawBoardPose(const StereoCalibration& design,
                                  const BoardSessionOptions& session, const RandomStream& view) {
  for (uint64_t draw = 0; draw < kMostDraws; ++draw) {
    const Pose X_LG = AnyBoardPose(design, session, view, draw);
    if (SeesBoard(design.left, X_LG, session.board) &&
        SeesBoard(design.right, design.X_RL * X_LG, session.board)) {
      return X_LG;
    }
  }
  return std::nullopt;
}

StereoObservation ShootBoard(const StereoRig& rig, const BoardWorld& world,
                             const BoardSessionOptions& session, const RandomStream& view) {
  Lighting lighting;
  lighting.sky.illuminance_lx = session.illuminance_lx;
  return rig.Still().Observe(world.caster(), lighting, RigPoseFor(rig, session, view), view);
}

Pose TrueBoardPose(const StereoRig& rig, const BoardSessionOptions& session,
                   const RandomStream& view) {
  return (RigPoseFor(rig, session, view) * rig.X_BL()).inverse() * BoardPose(session.board);
}

}  // namespace fenestra
