#pragma once

#include "core/detection/window_prior.h"
#include "core/io/parameter_table.h"
#include "vision/frame/frame_search.h"

namespace fenestra {

/// Options of plane-rgbd, each with the reason for its default.
struct PlaneRgbdOptions {
  FrameSearchOptions search{
      .limits = {.nearest_m = 0.4,    // The least that sensors of its kind see.
                 .farthest_m = 6.0},  // Their noise is 5 cm there, and a wall averages it out.
      .min_segment_px = 10.0};        // A third of the shortest side that is looked for at 5 m.

  // Properties of the depth sensor.
  /// Standard deviation of the inverse depth [1/m], from Khoshelham & Elberink 2012 for a Kinect.
  /// It is used only to find a plane; the plane's covariance is based on the noise that is measured
  /// there.
  double depth_noise_per_m = 1.425e-3;
  /// Quantum of the inverse depth [1/m]: 1/8 px of disparity over f b = 43 px m (ROS
  /// kinect_calibration/technical).
  double depth_step_per_m = 2.9e-3;
  /// Side of the block with which a depth pixel was matched, in pixels of a 640-wide image (ROS
  /// kinect_calibration/technical).
  double depth_window_px = 9.0;
  /// Largest depth that the sensor reports; 0: no limit. The Kinect SDK's limit is 4 m.
  double depth_to_m = 4.0;

  // How far the frame's front is behind the surrounding wall. It is measured for a frame that
  // returns depth itself or that has wall within it; for others this option is all that is known.
  double setback_m = 0.0;
  /// Standard deviation of setback_m, since windows are recessed by up to 10 cm; 0: the setback is
  /// exact.
  double setback_sigma_m = 0.1;

  /// A known size also enters the fit and improves the depth.
  WindowPrior prior;

  bool operator==(const PlaneRgbdOptions&) const = default;
};

/// Throws InputError with all faults.
void Validate(const PlaneRgbdOptions& options);

const ParameterTable<PlaneRgbdOptions>& PlaneRgbdParameters();

}  // namespace fenestra
