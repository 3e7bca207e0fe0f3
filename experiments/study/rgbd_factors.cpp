#include "experiments/study/factor_tables.h"

namespace fenestra {
namespace {

// The field of the settings that a factor stands for.
#define FIELD(path) FENESTRA_FIELD(path)

void AddRgbdDepth(FactorTable& t) {
  t.Choice(
       "rgbd_driver", FIELD(rgbd.driver), {"microsoft", "openni"},
       "Driver of the depth camera: 0.8–4 m in steps of 1/16 px, or 0.5–9 m in steps of 1/8 px.")
      .Switch("rgbd_near_mode", FIELD(rgbd.near_mode),
              "Whether the range of Microsoft's driver is 0.4–3 m instead of 0.8–4 m.")
      .Integer("rgbd_depth_width_px", FIELD(rgbd.depth_width_px), {64, 4096},
               "Width of the depth image.")
      .Integer("rgbd_depth_height_px", FIELD(rgbd.depth_height_px), {64, 4096},
               "Height of the depth image.")
      .Number("rgbd_depth_focal_px", FIELD(rgbd.depth_focal_px), {10.0, 1e4},
              "Focal length of the depth camera.")
      .Number("rgbd_projector_baseline_m", FIELD(rgbd.projector_baseline_m), {0.001, 1.0},
              "Distance from the depth camera to the projector.")
      .Switch("rgbd_quantised_disparity", FIELD(rgbd.quantised),
              "Whether disparities come in the driver's steps.")
      .Number("rgbd_fixed_disparity_noise_px", FIELD(rgbd.parametric.fixed_disparity_noise_px),
              {0.0, 10.0},
              "Standard deviation of the disparity noise that all depth images of a view share; "
              "parametric model only.")
      .Number("rgbd_temporal_disparity_noise_px",
              FIELD(rgbd.parametric.temporal_disparity_noise_px), {0.0, 10.0},
              "Standard deviation of the disparity noise where dots are as strong as the image "
              "noise; parametric model only.")
      .Number("rgbd_dot_signal_dn", FIELD(rgbd.infrared.dot_signal_dn), {0.0, 1e6},
              "Signal of a dot on a surface of reflectance 0.8 at 1 m.")
      .Number("rgbd_projector_power_mw", FIELD(rgbd.infrared.projector_power_w),
              {1e-3, 1e6, kMilli}, "Radiant power of the projector.")
      .Number("rgbd_dark_noise_dn", FIELD(rgbd.infrared.dark_noise_dn), {0.0, 1e4},
              "Standard deviation of the infra-red image's noise in the dark.")
      .Number("rgbd_shot_noise_dn", FIELD(rgbd.infrared.shot_noise_dn), {0.0, 1e3},
              "Variance of the infra-red image's noise per DN of signal.")
      .Number("rgbd_saturation_dn", FIELD(rgbd.infrared.saturation_dn), {1.0, 1023.0},
              "Full scale of the infra-red image.")
      .Number("rgbd_filter_width_nm", FIELD(rgbd.infrared.filter_width_nm), {0.1, 1e3},
              "Full width of the infra-red filter's pass band.")
      .Choice("rgbd_depth_model", FIELD(rgbd.depth_model), {"parametric", "speckle"},
              "Model of the depth image: formulae, or matching in an infra-red image of the dots.")
      .Integer("rgbd_infrared_width_px", FIELD(rgbd.infrared_width_px), {64, 4096},
               "Width of the infra-red image that the speckle model matches; a multiple of the "
               "depth image's.")
      .Integer("rgbd_averaged_frames", FIELD(rgbd.averaged_frames), {1, 1000},
               "Number of depth images that are averaged, each with noise of its own.")
      .Switch("rgbd_registered_depth", FIELD(rgbd.registered_depth),
              "Whether depth is delivered as the colour camera would see it, as drivers do.")
      .Number("rgbd_dot_sigma_px", FIELD(rgbd.infrared.dot_sigma_px), {0.1, 1.0},
              "Standard deviation of a dot's spread in the infra-red image.")
      .Number("rgbd_speckle_contrast", FIELD(rgbd.infrared.speckle_contrast), {0.0, 1.0},
              "Contrast of the laser's speckle in a pixel, as far as it stays in all images.")
      .Number("rgbd_speckle_flicker", FIELD(rgbd.infrared.speckle_flicker), {0.0, 1.0},
              "Contrast of the laser's speckle in a pixel that is drawn anew for each image.")
      .Number("rgbd_corner_illumination", FIELD(rgbd.infrared.corner_illumination), {0.05, 1.0},
              "Share of the dots' light in the corners, besides what follows from the angle.")
      .Switch("rgbd_infrared_auto_exposure", FIELD(rgbd.infrared.auto_exposure),
              "Whether the infra-red exposure is shortened where light would saturate the image.")
      .Integer("rgbd_matching_window_width_px", FIELD(rgbd.matching.block_width_px), {3, 15},
               "Width of the block that is matched; odd.")
      .Integer("rgbd_matching_window_height_px", FIELD(rgbd.matching.block_height_px), {3, 15},
               "Height of the block that is matched; odd.")
      .Number("rgbd_least_correlation", FIELD(rgbd.matching.least_correlation), {0.01, 0.99},
              "Least correlation coefficient of a match that is accepted.")
      .Number("rgbd_search_px", FIELD(rgbd.matching.search_px), {1.0, 200.0},
              "Range of disparities that is searched, in pixels of a 640-wide image.");
}

void AddRgbdUnit(FactorTable& t) {
  t.Switch("rgbd_unit_per_trial", FIELD(rgbd_unit_per_trial),
           "Whether each trial has a sensor of its own, which deviates from what is known of it, "
           "instead of one that all share.")
      .Choice("rgbd_calibration", FIELD(rgbd_calibration.source), {"exact", "perturbed", "factory"},
              "Calibration that detectors are given: the truth, one of this unit with random "
              "errors, or the constants of a driver.")
      .Number("rgbd_calibration_focal_error_percent",
              FIELD(rgbd_calibration.perturbed.focal_length), {0.0, 20.0, kPercent},
              "Standard deviation of each camera's focal length from a perturbed calibration.")
      .Number("rgbd_calibration_principal_point_error_px",
              FIELD(rgbd_calibration.perturbed.principal_point_px), {0.0, 100.0},
              "Standard deviation of each camera's principal point from a perturbed calibration, "
              "per axis, in pixels of a 640-wide image.")
      .Number("rgbd_calibration_distortion_error_percent",
              FIELD(rgbd_calibration.perturbed.color_distortion), {0.0, 50.0, kPercent},
              "Standard deviation of each distortion coefficient of the colour lens from a "
              "perturbed calibration.")
      .Number("rgbd_calibration_rotation_error_mrad",
              FIELD(rgbd_calibration.perturbed.rotation_rad), {0.0, 50.0, kMilli},
              "Standard deviation per axis of the rotation between the cameras from a perturbed "
              "calibration.")
      .Number("rgbd_calibration_translation_error_mm",
              FIELD(rgbd_calibration.perturbed.translation_m), {0.0, 50.0, kMilli},
              "Standard deviation per axis of the translation between the cameras from a "
              "perturbed calibration.")
      .Number("rgbd_disparity_scale_error_percent",
              FIELD(rgbd_calibration.perturbed.disparity_scale), {0.0, 20.0, kPercent},
              "Standard deviation of the scale of disparities in a perturbed calibration.")
      .Number("rgbd_disparity_offset_error_px",
              FIELD(rgbd_calibration.perturbed.disparity_offset_px), {0.0, 5.0},
              "Standard deviation of the offset of disparities in a perturbed calibration, in "
              "pixels of a 640-wide image.")
      .Number("rgbd_disparity_warp_px", FIELD(rgbd_calibration.perturbed.disparity_warp_px),
              {0.0, 5.0},
              "RMS of the smooth error of disparities over the image in a perturbed calibration, "
              "in pixels of a 640-wide image.");
}

void AddRgbdMotion(FactorTable& t) {
  AddMotionFactors(t, "rgbd", FIELD(rgbd.motion));
  t.Number("rgbd_color_delay_ms", FIELD(rgbd.color_delay_s), {-1000.0, 1000.0, kMilli},
           "Time from the depth image to the colour image.");
  t.Number("rgbd_infrared_readout_ms", FIELD(rgbd.infrared_readout_s), {0.0, 1000.0, kMilli},
           "Time from the depth camera's first row to its last in a rolling shutter; 0: none.")
      .Number("rgbd_color_readout_ms", FIELD(rgbd.color.readout_s), {0.0, 1000.0, kMilli},
              "Time from the colour camera's first row to its last in a rolling shutter; 0: none.");
}

#undef FIELD

}  // namespace

void AddRgbdFactors(FactorTable& table) {
  AddRgbdDepth(table);
  AddRgbdUnit(table);
  AddRgbdMotion(table);
}

}  // namespace fenestra
