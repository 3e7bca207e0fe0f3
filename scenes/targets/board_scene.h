#pragma once

#include "core/geometry/calibration_board.h"
#include "scenes/scene.h"

namespace fenestra {

/// A calibration board on a grey wall, all in the plane z = 0 and facing +Z: a board on a stand
/// that a rig is moved around. Around the squares is a white margin, one square wide.
struct BoardSceneOptions {
  CalibrationBoard board;
  double white_reflectance = 0.80;  ///< Matt print: 0.8–0.85.
  double black_reflectance = 0.05;  ///< Matt print: 0.04–0.05.
  double wall_reflectance = 0.60;   ///< So that an exposure for the scene keeps the board's white.
  double wall_width_m = 12.0;       ///< The wall is centred on the board.
  double wall_height_m = 8.0;
};

/// X_WG: the board's frame in the world; its centre is the world's origin.
Pose BoardPose(const CalibrationBoard& board);

/// The scene with the board. Throws InputError for an invalid board or one that does not fit on the
/// wall.
Scene MakeBoardScene(const BoardSceneOptions& options);

}  // namespace fenestra
