#pragma once

#include "core/parameter_table.h"
#include "vision/window_prior.h"

namespace fenestra {

/// What plane-rgbd takes for a window, each with the reason for its default.
struct PlaneRgbdOptions {
  // Where and how large a window may be.
  double nearest_m = 0.4;   ///< The least that sensors of its kind see.
  double farthest_m = 6.0;  ///< Their noise is 5 cm there, and a wall averages it out.
  double min_side_m = 0.3;  ///< What a drone might fly through.
  double max_side_m = 3.0;
  double max_side_ratio = 2.0;
  /// Of a quadrilateral's corners on the plane around it: a side that is 40 px long is known to 5°.
  double max_skew_rad = 0.2617993877991494;
  double max_taper = 0.25;

  // How it may look.
  double min_contrast_dn = 6.0;   ///< As edge-stereo's.
  double vignetting_power = 4.5;  ///< As edge-stereo's.
  /// A third of the shortest side that is looked for at 5 m.
  double min_segment_px = 10.0;
  int most_segments = 150;        ///< As edge-stereo's.
  int most_candidates = 8;        ///< As edge-stereo's.
  int most_windows = 2;           ///< As edge-stereo's.
  double min_side_support = 0.4;  ///< As edge-stereo's.
  double min_darkness = 0.25;     ///< As edge-stereo's.
  double min_border_m = 0.02;
  double max_border_share = 0.3;  ///< Of the shorter side.

  // What is known of the depth.
  /// Standard deviation of the inverse depth [1/m]: Khoshelham & Elberink 2012 for a Kinect. Only
  /// where a plane is looked for; its covariance rests on the noise that is measured there.
  double depth_noise_per_m = 1.425e-3;
  /// Quantum of the inverse depth [1/m]: 1/8 px of disparity over f b = 43 px m (ROS
  /// kinect_calibration/technical).
  double depth_step_per_m = 2.9e-3;
  /// Side of the window in which a depth pixel was matched, in pixels of a 640-wide image (ROS
  /// kinect_calibration/technical).
  double depth_window_px = 9.0;
  /// Largest depth that the sensor gives; 0: no limit. Kinect SDK: 4 m.
  double depth_to_m = 4.0;

  // How far the frame's front is behind the wall around it; where it has no depth of its own, the
  // wall's is all there is.
  double setback_m = 0.0;
  double setback_sigma_m = 0.0;  ///< Standard deviation of that knowledge; 0: a flush frame.

  /// A known size also goes into the fit, and helps the depth.
  WindowPrior prior;

  bool operator==(const PlaneRgbdOptions&) const = default;
};

/// Throws InputError with all faults.
void Validate(const PlaneRgbdOptions& options);

const ParameterTable<PlaneRgbdOptions>& PlaneRgbdParameters();

}  // namespace fenestra
