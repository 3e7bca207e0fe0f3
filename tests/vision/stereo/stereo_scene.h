#pragma once

#include "core/detection/observation.h"
#include "core/geometry/calibration.h"
#include "core/random/random_stream.h"
#include "tests/support/planar_target.h"
#include "vision/stereo/edge/edge_stereo.h"

namespace fenestra::testing {

/// The grey values of a black frame on a white wall, and of the camera that takes it.
struct Photo {
  double wall_dn = 165.0;
  double frame_dn = 12.0;
  double noise_dn = 0.0;  ///< Standard deviation, independent for each pixel.
  double blur_px = 0.45;  ///< Standard deviation of the lens' Gaussian blur.
};

/// The paper's rig: 752 x 480 pixels, 4 mm lenses on 6 µm pixels, 35 cm apart.
StereoCalibration PaperRig(const BrownConrady& distortion = {},
                           const Eigen::Vector3d& right_rotation_rad = Eigen::Vector3d::Zero(),
                           double baseline_m = 0.35);

/// A window that the middle of the rig faces from `distance_m`, seen from `azimuth`, then rolled,
/// pitched and yawed: X_LO.
struct View {
  double distance_m = 3.0;
  double azimuth_deg = 0.0;
  double yaw_deg = 0.0;
  double pitch_deg = 0.0;
  double roll_deg = 0.0;
};
Pose WindowSeenFrom(const View& view, double baseline_m = 0.35);

/// What the rig sees of the target; for noise, one stream.
StereoObservation Photograph(const StereoCalibration& rig, const Pose& X_LO,
                             const PlanarTarget& target, const Photo& photo,
                             const RandomStream& stream);

/// Options of a detector of edges for pictures that have the edges that it assumes.
EdgeStereoOptions OptionsForExactPictures();

}  // namespace fenestra::testing
