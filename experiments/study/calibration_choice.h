#pragma once

#include "core/geometry/calibration_board.h"

namespace fenestra {

/// Where a detector's knowledge of its stereo rig comes from.
enum class CalibrationSource {
  kExact,      ///< The true rig.
  kPerturbed,  ///< The true rig with a random error of the right camera's pose.
  kBoards,     ///< Calibrated with pictures of a board: intrinsics, extrinsics, errors and all.
               ///< These pictures have noise even if the rig's options leave it out.
  kStale,      ///< Calibrated with boards before the right camera was displaced.
  kDesign,     ///< The rig as designed: never calibrated.
};

struct CalibrationChoice {
  CalibrationSource source = CalibrationSource::kPerturbed;
  /// kPerturbed: standard deviations about and along each axis. About what 20 boards leave behind.
  double rotation_error_rad = 1e-4;
  double translation_error_m = 1e-4;
  /// kBoards, kStale.
  int boards = 20;
  BoardKind board = BoardKind::kChessboard;
  /// kStale: displacement of the right camera, standard deviations about and along each axis; what
  /// a hard landing does to a bar. Assumed.
  double shake_rotation_rad = 5e-4;
  double shake_translation_m = 1e-4;
};

}  // namespace fenestra
