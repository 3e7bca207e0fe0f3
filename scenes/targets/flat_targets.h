#pragma once

#include <optional>

#include "core/geometry/calibration_board.h"
#include "scenes/scene.h"
#include "scenes/targets/board_shape.h"

namespace fenestra {

/// The target of the paper (Zhou et al., RED-UAS 2013, section 3): "a square with black edge on a
/// white wall". Sizes and reflectances are not given there; the choices below are ours.
struct PaperTargetOptions {
  double width_m = 1.0;  ///< Outer width of the black border.
  double height_m = 1.0;
  double border_m = 0.10;      ///< Width of the black border.
  double wall_width_m = 12.0;  ///< The wall is centred on the target.
  double wall_height_m = 8.0;
  double wall_reflectance = 0.80;  ///< White paint: 0.8–0.85.
  double wall_reflectance_830nm = 0.80;
  double frame_reflectance = 0.05;        ///< Black paint: 0.04–0.05.
  double frame_reflectance_830nm = 0.05;  ///< Ordinary black paint is black in the infra-red too.
  bool with_target = true;                ///< false: a bare wall.
};

/// A flat square with a black border, painted on the wall plane z = 0; inside it is wall. The
/// centroid is the world's origin. Throws InputError for sizes that do not fit into each other.
Scene MakePaperTarget(const PaperTargetOptions& options);

/// A calibration board on a grey wall, both facing +Z: a board on a stand that a rig is moved
/// around. As drawn, all is in the plane z = 0. Around the squares is a white margin, one square
/// wide, which the board's deviations move too.
struct BoardSceneOptions {
  CalibrationBoard board;
  std::optional<BoardShape> shape{};  ///< Of this board, as made; nullopt: as drawn.
  double white_reflectance = 0.80;    ///< Matt print: 0.8–0.85.
  double black_reflectance = 0.05;    ///< Matt print: 0.04–0.05.
  double wall_reflectance = 0.60;  ///< So that an exposure for the scene keeps the board's white.
  double wall_width_m = 12.0;      ///< The wall is centred on the board.
  double wall_height_m = 8.0;
};

/// X_WG: the board's frame in the world; its centre is the world's origin.
Pose BoardPose(const CalibrationBoard& board);

/// The scene with the board. Throws InputError for an invalid board or one that does not fit on the
/// wall.
Scene MakeBoardScene(const BoardSceneOptions& options);

}  // namespace fenestra
