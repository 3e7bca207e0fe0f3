#include "sim/stereo/stereo_rig_options.h"

#include <fmt/format.h>

#include "core/io/faults.h"

namespace fenestra {
namespace {

// Assumes positive lengths.
CameraModel DesignedCamera(const StereoRigOptions& options) {
  const double f_px = options.focal_length_m / options.pixel_pitch_m;
  return CameraModel({.width_px = options.width_px,
                      .height_px = options.height_px,
                      .fx_px = f_px,
                      .fy_px = f_px,
                      .cx_px = 0.5 * (options.width_px - 1),
                      .cy_px = 0.5 * (options.height_px - 1),
                      .distortion = options.distortion});
}

bool DistortionIsInvertible(const CameraModel& camera) {
  for (const double u : {-0.5, camera.width_px() - 0.5}) {
    for (const double v : {-0.5, camera.height_px() - 0.5}) {
      if (!camera.UnprojectRay({u, v})) return false;
    }
  }
  return true;
}

}  // namespace

void Validate(const StereoRigOptions& o) {
  Faults faults("stereo rig");
  faults.Require(o.pixel_pitch_m > 0.0,
                 fmt::format("pixel pitch {} m is not positive", o.pixel_pitch_m));
  faults.Require(o.focal_length_m > 0.0,
                 fmt::format("focal length {} m is not positive", o.focal_length_m));
  faults.Require(o.baseline_m > 0.0, fmt::format("baseline {} m is not positive", o.baseline_m));
  faults.Require(o.lens.f_number > 0.0,
                 fmt::format("f-number {} is not positive", o.lens.f_number));
  faults.Require(o.exposure.shortest_s <= o.exposure.longest_s,
                 fmt::format("shortest exposure {} s is longer than the longest, {} s",
                             o.exposure.shortest_s, o.exposure.longest_s));
  faults.Require(o.lens.blur_sigma_px >= 0.0 && o.lens.corner_blur_sigma_px >= o.lens.blur_sigma_px,
                 fmt::format("blur {} px in the corners is less than {} px in the centre",
                             o.lens.corner_blur_sigma_px, o.lens.blur_sigma_px));
  faults.Require(o.focus_distance_m > 0.0,
                 fmt::format("focus distance {} m is not positive", o.focus_distance_m));
  faults.Require(o.hover.speed_m_s >= 0.0 && o.hover.turn_rad_s >= 0.0,
                 "speeds of hovering must not be negative");
  const RigTolerances& t = o.tolerances;
  faults.Require(t.focal_length >= 0.0 && t.principal_point_px >= 0.0 && t.distortion >= 0.0 &&
                     t.rotation_rad >= 0.0 && t.translation_m >= 0.0 && t.gain >= 0.0 &&
                     t.sensor_tilt_rad >= 0.0 && t.coma_centre >= 0.0,
                 "tolerances must not be negative");
  if (faults.count() == 0 && !DistortionIsInvertible(DesignedCamera(o))) {
    faults.Add("the distortion folds the image over before its corners");
  }
  faults.ThrowIfAny();
}

StereoCalibration DesignOf(const StereoRigOptions& options) {
  Validate(options);
  const CameraModel camera = DesignedCamera(options);
  return {
      .left = camera, .right = camera, .X_RL = Pose::Translation({-options.baseline_m, 0.0, 0.0})};
}

}  // namespace fenestra
