#include "core/geometry/pose.h"
#include "experiments/study/factor_tables.h"

namespace fenestra {
namespace {

// The field of the settings that a factor stands for.
#define FIELD(path) FENESTRA_FIELD(path)

void AddStereoCameras(FactorTable& t) {
  t.Integer("stereo_width_px", FIELD(stereo.width_px), {64, 4096}, "Width of each image.")
      .Integer("stereo_height_px", FIELD(stereo.height_px), {64, 4096}, "Height of each image.")
      .Number("stereo_pixel_pitch_um", FIELD(stereo.pixel_pitch_m), {0.5, 50.0, kMicro},
              "Distance from one pixel's centre to the next.")
      .Number("stereo_focal_length_mm", FIELD(stereo.focal_length_m), {0.5, 100.0, kMilli},
              "Focal length of each lens.")
      .Number("stereo_baseline_m", FIELD(stereo.baseline_m), {0.01, 5.0},
              "Distance from the left camera to the right one.")
      .Number("stereo_k1", FIELD(stereo.distortion.k1), {-1.0, 1.0},
              "Radial distortion, second order.")
      .Number("stereo_k2", FIELD(stereo.distortion.k2), {-1.0, 1.0},
              "Radial distortion, fourth order.")
      .Number("stereo_k3", FIELD(stereo.distortion.k3), {-1.0, 1.0},
              "Radial distortion, sixth order.")
      .Number("stereo_p1", FIELD(stereo.distortion.p1), {-0.1, 0.1},
              "Tangential distortion, coefficient p1 of OpenCV's model.")
      .Number("stereo_p2", FIELD(stereo.distortion.p2), {-0.1, 0.1},
              "Tangential distortion, coefficient p2 of OpenCV's model.")
      .Integer("stereo_edge_samples", FIELD(stereo.edge_samples_per_pixel), {4, 256},
               "Rays through a pixel with more in it than one edge: 16, 64 or 256; 4: as for any "
               "other pixel.");
}

void AddStereoRig(FactorTable& t) {
  t.Switch("stereo_rig_per_trial", FIELD(stereo_rig_per_trial),
           "Whether each trial has a rig of its own, within the tolerances, instead of one that "
           "all share.")
      .Switch("stereo_as_designed", FIELD(stereo.as_designed),
              "Whether the rig is built exactly as designed; tolerances have no effect then.")
      .Number("stereo_focal_tolerance_percent", FIELD(stereo.tolerances.focal_length),
              {0.0, 20.0, kPercent}, "Standard deviation of each lens' focal length as built.")
      .Number("stereo_principal_point_tolerance_px", FIELD(stereo.tolerances.principal_point_px),
              {0.0, 100.0},
              "Standard deviation of each camera's principal point as built, per axis.")
      .Number("stereo_distortion_tolerance_percent", FIELD(stereo.tolerances.distortion),
              {0.0, 50.0, kPercent}, "Standard deviation of each distortion coefficient as built.")
      .Number("stereo_rotation_tolerance_mrad", FIELD(stereo.tolerances.rotation_rad),
              {0.0, 50.0, kMilli},
              "Standard deviation of each camera's orientation as mounted, per axis.")
      .Number("stereo_translation_tolerance_mm", FIELD(stereo.tolerances.translation_m),
              {0.0, 50.0, kMilli},
              "Standard deviation of each camera's position as mounted, per axis.")
      .Number("stereo_gain_tolerance_percent", FIELD(stereo.tolerances.gain), {0.0, 15.0, kPercent},
              "Standard deviation of each camera's grey values per electron as built.")
      .Number("stereo_sensor_tilt_tolerance_mrad", FIELD(stereo.tolerances.sensor_tilt_rad),
              {0.0, 50.0, kMilli},
              "Standard deviation of each sensor's tilt against its lens as built, per axis.")
      .Number("stereo_coma_centre_tolerance_percent", FIELD(stereo.tolerances.coma_centre),
              {0.0, 100.0, kPercent},
              "Standard deviation of where each lens has no coma, per axis, in half diagonals from "
              "the image's centre.")
      .Choice("stereo_calibration", FIELD(stereo_calibration.source),
              {"exact", "perturbed", "boards", "stale", "design"},
              "Calibration that detectors are given: as built, as built with the random error that "
              "boards and drift leave, from pictures of boards, from boards before the rig was "
              "shaken, or as designed.")
      .Integer("stereo_calibration_boards", FIELD(stereo_calibration.boards), {3, 1000},
               "Number of pictures of the board that the rig is calibrated with.")
      .Choice("stereo_calibration_board", FIELD(stereo_calibration.board),
              {"chessboard", "charuco"}, "Kind of board that the rig is calibrated with.")
      .Number("stereo_board_bow_percent", FIELD(stereo_calibration.board_tolerances.bow),
              {0.0, 5.0, kPercent},
              "Standard deviation of the board's bow along each side, and of its twist, as a share "
              "of the diagonal.")
      .Number("stereo_board_line_error_percent",
              FIELD(stereo_calibration.board_tolerances.line_error), {0.0, 10.0, kPercent},
              "Standard deviation of each line of the board as printed, as a share of a square.")
      .Number("stereo_board_scale_percent", FIELD(stereo_calibration.board_tolerances.print_scale),
              {0.0, 10.0, kPercent},
              "Standard deviation of the scale at which the board is printed.")
      .Number("stereo_board_anisotropy_percent",
              FIELD(stereo_calibration.board_tolerances.print_anisotropy), {0.0, 10.0, kPercent},
              "Standard deviation of the print's scale along one axis against the other.")
      .Switch("stereo_calibration_free_k3", FIELD(stereo_calibration.free_k3),
              "Whether a calibration with boards adjusts k3 too, or takes it to be 0.")
      .Number("stereo_shake_rotation_mrad", FIELD(stereo_calibration.shake_rotation_rad),
              {0.0, 50.0, kMilli},
              "Standard deviation per axis of the right camera's turn after a stale calibration.")
      .Number("stereo_shake_translation_mm", FIELD(stereo_calibration.shake_translation_m),
              {0.0, 50.0, kMilli},
              "Standard deviation per axis of the right camera's shift after a stale calibration.")
      .Number(
          "stereo_calibration_rotation_error_mrad", FIELD(stereo_calibration.rotation_error_rad),
          {0.0, 50.0, kMilli},
          "Standard deviation per axis of the right camera's drift in rotation since a perturbed "
          "calibration.")
      .Number("stereo_calibration_translation_error_mm",
              FIELD(stereo_calibration.translation_error_m), {0.0, 50.0, kMilli},
              "Standard deviation per axis of the right camera's drift in translation since a "
              "perturbed calibration.")
      .Number("stereo_calibration_corner_noise_px", FIELD(stereo_calibration.corner_noise_px),
              {0.0, 10.0},
              "Standard deviation of the corners' coordinates of a perturbed calibration.");
  AddMotionFactors(t, "stereo", FIELD(stereo.motion));
  t.Number("stereo_hover_speed_m_s", FIELD(stereo.hover.speed_m_s), {0.0, 10.0},
           "Standard deviation per axis of the velocity of a hovering rig, new in each image.")
      .Number("stereo_hover_turn_deg_s", FIELD(stereo.hover.turn_rad_s), {0.0, 500.0, kDegree},
              "Standard deviation per axis of the rate at which a hovering rig turns.")
      .Number("stereo_trigger_skew_us", FIELD(stereo.trigger_skew_s), {-1e6, 1e6, kMicro},
              "Delay of the right camera's exposure after the left one's.");
}

#undef FIELD

}  // namespace

void AddStereoFactors(FactorTable& table) {
  AddStereoCameras(table);
  AddStereoRig(table);
}

}  // namespace fenestra
