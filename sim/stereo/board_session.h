#pragma once

#include <memory>
#include <optional>

#include "core/geometry/calibration_board.h"
#include "scenes/targets/board_shape.h"
#include "sim/stereo/stereo_rig.h"

namespace fenestra {

/// Calibration of a rig: pairs of images of a board from many sides.
struct BoardSessionOptions {
  CalibrationBoard board;
  BoardTolerances tolerances{};  ///< Of the board as made; who calibrates believes in `board`.
  int views = 20;
  double illuminance_lx = 3000.0;  ///< A room by its window, or under studio lamps.
  /// Width of the board as a share of the image's width.
  double smallest_share = 0.25;
  double largest_share = 0.55;
  double largest_tilt_rad = 0.70;  ///< 40°: beyond it corners become slivers.
  double largest_roll_rad = 0.26;  ///< 15°, about the optical axis.
};

/// Throws InputError with all faults.
void Validate(const BoardSessionOptions& options);

/// A board as made, with the ray caster of its scene.
class BoardWorld {
 public:
  explicit BoardWorld(const BoardShape& shape);
  const BoardShape& shape() const { return shape_; }
  const RayCaster& caster() const { return *caster_; }

 private:
  BoardShape shape_;
  std::unique_ptr<const RayCaster> caster_;
};

/// Draws X_LG, the pose of the board in the left camera as designed, for one view. Size, tilt, roll
/// and place in the image are uniform, such that both cameras as designed see the board with a
/// margin of 3 % of the image's width. nullopt if there is no such pose, because the cameras' views
/// do not overlap enough for this board.
std::optional<Pose> DrawBoardPose(const StereoCalibration& design,
                                  const BoardSessionOptions& session, const RandomStream& view);

/// Images of the board with the rig's own optics, noise and exposure, while the rig stands still.
/// Throws InputError if the cameras' views do not overlap enough.
StereoObservation ShootBoard(const StereoRig& rig, const BoardWorld& world,
                             const BoardSessionOptions& session, const RandomStream& view);

/// X_LG of the board in the rig's true left camera, for the view that ShootBoard takes.
Pose TrueBoardPose(const StereoRig& rig, const BoardSessionOptions& session,
                   const RandomStream& view);

}  // namespace fenestra
