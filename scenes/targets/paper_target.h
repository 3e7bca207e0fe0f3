#pragma once

#include "scenes/scene.h"

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

}  // namespace fenestra
