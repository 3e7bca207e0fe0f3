#pragma once

#include "scenes/scene.h"

namespace fenestra {

/// A plain facade with one real window: an opening in the wall, its reveal, a frame, a pane of
/// glass that can be left out, and a dark room behind.
struct FacadeOptions {
  double width_m = 1.0;  ///< Outer width of the frame, which fills the opening.
  double height_m = 1.0;
  double frame_width_m = 0.10;     ///< Seen from the front.
  double frame_depth_m = 0.06;     ///< Along the wall's normal.
  double frame_setback_m = 0.0;    ///< Front of the frame behind the wall's outer face.
  double wall_thickness_m = 0.30;  ///< The reveal runs from the outer face to here.
  double room_depth_m = 4.0;       ///< Behind the wall's inner face.
  bool glass = true;               ///< A pane in the middle of the frame's depth.
  double wall_width_m = 12.0;
  double wall_height_m = 8.0;
  double wall_reflectance = 0.80;
  double wall_reflectance_830nm = 0.80;
  double frame_reflectance = 0.05;
  double frame_reflectance_830nm = 0.05;
  double room_reflectance = 0.30;
  double room_reflectance_830nm = 0.30;
  bool with_target = true;  ///< false: a wall without an opening.
};

/// The target's centroid is (0, 0, -frame_setback_m). Throws InputError for sizes that do not fit
/// into each other.
Scene MakeFacade(const FacadeOptions& options);

}  // namespace fenestra
