#include "experiments/study/factors.h"

#include <fmt/format.h>

#include "core/geometry/pose.h"
#include "core/system/check.h"
#include "experiments/study/facade_factors.h"

namespace fenestra {
namespace {

using Table = ParameterTable<TrialSettings>;

constexpr double kMilli = 1e-3;
constexpr double kMicro = 1e-6;
constexpr double kPercent = 1e-2;

// The field of the settings that a factor stands for.
#define FIELD(path) FENESTRA_FIELD(path)

void AddViewpoint(Table& t) {
  t.Number("distance_m", FIELD(viewpoint.distance_m), {0.1, 100.0},
           "Distance from the window's centroid to the rig.")
      .Number("azimuth_deg", FIELD(viewpoint.azimuth_rad), {-89.0, 89.0, kDegree},
              "Direction of the rig as seen from the window, to the viewer's right.")
      .Number("elevation_deg", FIELD(viewpoint.elevation_rad), {-89.0, 89.0, kDegree},
              "Direction of the rig as seen from the window, upwards.")
      .Number("yaw_deg", FIELD(viewpoint.yaw_rad), {-180.0, 180.0, kDegree},
              "Turn of the rig to the right, away from looking at the centroid.")
      .Number("pitch_deg", FIELD(viewpoint.pitch_rad), {-180.0, 180.0, kDegree},
              "Turn of the rig upwards, after the yaw.")
      .Number("roll_deg", FIELD(viewpoint.roll_rad), {-180.0, 180.0, kDegree},
              "Turn of the rig clockwise about its optical axis, after the pitch.");
}

void AddScene(Table& t) {
  t.Choice("scene", FIELD(scene), {kPaperTargetScene, kFacadeScene},
           "A black square painted on a wall, or a wall with a real window.")
      .Switch("target", FIELD(facade.with_target), "Whether there is a window to find.")
      .Number("window_width_m", FIELD(facade.window.width_m), {0.05, 20.0},
              "Outer width of the window frame.")
      .Number("window_height_m", FIELD(facade.window.height_m), {0.05, 20.0},
              "Outer height of the window frame.")
      .Number("frame_width_m", FIELD(facade.window.frame_width_m), {0.001, 5.0},
              "Width of the window frame's members or of the painted border, seen from the front.")
      .Number("wall_width_m", FIELD(facade.wall.width_m), {0.1, 200.0},
              "Width of the wall, which is centred on the window.")
      .Number("wall_height_m", FIELD(facade.wall.height_m), {0.1, 200.0},
              "Height of the wall, which is centred on the window.")
      .Number("wall_reflectance", FIELD(facade.wall.paint.reflectance), {0.0, 1.0},
              "Reflectance of the wall in visible light.")
      .Number("wall_reflectance_830nm", FIELD(facade.wall.paint.reflectance_830nm), {0.0, 1.0},
              "Reflectance of the wall in the projector's infra-red.")
      .Number("frame_reflectance", FIELD(facade.window.frame.reflectance), {0.0, 1.0},
              "Reflectance of the window frame in visible light.")
      .Number("frame_reflectance_830nm", FIELD(facade.window.frame.reflectance_830nm), {0.0, 1.0},
              "Reflectance of the window frame in the projector's infra-red.");
}

void AddLight(Table& t) {
  // 128 klx is the solar illuminance outside the atmosphere; a bright overcast sky gives 20 klx.
  t.Number("sun_illuminance_lx", FIELD(lighting.sun.illuminance_lx), {0.0, 128e3},
           "Illuminance by the sun on a plane perpendicular to its rays; 0: no sun.")
      .Number("sun_azimuth_deg", FIELD(lighting.sun.azimuth_rad), {-180.0, 180.0, kDegree},
              "Direction of the sun from the wall's normal, to the viewer's right.")
      .Number("sun_elevation_deg", FIELD(lighting.sun.elevation_rad), {0.0, 90.0, kDegree},
              "Height of the sun above the horizon.")
      .Number("sky_illuminance_lx", FIELD(lighting.sky.illuminance_lx), {0.0, 128e3},
              "Illuminance by the sky on an unobstructed horizontal plane.")
      .Choice("sky_model", FIELD(lighting.sky.model), {"uniform", "cie_overcast", "cie_clear"},
              "How the sky's light is spread over it; a clear sky follows the sun's position.")
      .Number("ground_reflectance", FIELD(lighting.sky.ground_reflectance), {0.0, 1.0},
              "Reflectance of the ground, which reflects the sky's and the sun's light.")
      .Number("ambient_830nm_ratio", FIELD(lighting.irradiance_830_per_lux),
              {0.0, 100.0, kDaylightIrradiance830PerLux},
              "Infra-red at 830 nm per lux of ambient light, in multiples of daylight's; 1: "
              "daylight, 0: LED lamps.");
}

void AddStereoCameras(Table& t) {
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

void AddMotion(Table& t, const std::string& sensor, Table::Field<RigMotion> of) {
  ParameterTable<RigMotion> motion;
  motion
      .Number(sensor + "_speed_right_m_s", FIELD(velocity_B.x()), {-100.0, 100.0},
              "Velocity of the rig to its right.")
      .Number(sensor + "_speed_down_m_s", FIELD(velocity_B.y()), {-100.0, 100.0},
              "Velocity of the rig downwards, along its own axis.")
      .Number(sensor + "_speed_forward_m_s", FIELD(velocity_B.z()), {-100.0, 100.0},
              "Velocity of the rig in the direction in which it looks.")
      .Number(sensor + "_pitch_rate_deg_s", FIELD(angular_velocity_B.x()),
              {-2000.0, 2000.0, kDegree}, "Rate at which the rig turns upwards.")
      .Number(sensor + "_yaw_rate_deg_s", FIELD(angular_velocity_B.y()), {-2000.0, 2000.0, kDegree},
              "Rate at which the rig turns to the right.")
      .Number(sensor + "_roll_rate_deg_s", FIELD(angular_velocity_B.z()),
              {-2000.0, 2000.0, kDegree}, "Rate at which the rig turns clockwise.");
  t.Adopt<RigMotion>(motion, of);
}

void AddStereoRig(Table& t) {
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
      .Choice("stereo_calibration", FIELD(stereo_calibration.source),
              {"exact", "perturbed", "boards", "stale", "design"},
              "Calibration that detectors are given: as built, as built with a random error, from "
              "pictures of boards, from boards before the rig was shaken, or as designed.")
      .Integer("stereo_calibration_boards", FIELD(stereo_calibration.boards), {3, 1000},
               "Number of pictures of the board that the rig is calibrated with.")
      .Choice("stereo_calibration_board", FIELD(stereo_calibration.board),
              {"chessboard", "charuco"}, "Kind of board that the rig is calibrated with.")
      .Number("stereo_shake_rotation_mrad", FIELD(stereo_calibration.shake_rotation_rad),
              {0.0, 50.0, kMilli},
              "Standard deviation per axis of the right camera's turn after a stale calibration.")
      .Number("stereo_shake_translation_mm", FIELD(stereo_calibration.shake_translation_m),
              {0.0, 50.0, kMilli},
              "Standard deviation per axis of the right camera's shift after a stale calibration.")
      .Number("stereo_calibration_rotation_error_mrad",
              FIELD(stereo_calibration.rotation_error_rad), {0.0, 50.0, kMilli},
              "Standard deviation per axis of the rotation between the cameras in a perturbed "
              "calibration.")
      .Number("stereo_calibration_translation_error_mm",
              FIELD(stereo_calibration.translation_error_m), {0.0, 50.0, kMilli},
              "Standard deviation per axis of the translation between the cameras in a perturbed "
              "calibration.");
  AddMotion(t, "stereo", FIELD(stereo.motion));
  t.Number("stereo_trigger_skew_us", FIELD(stereo.trigger_skew_s), {-1e6, 1e6, kMicro},
           "Delay of the right camera's exposure after the left one's.");
}

void AddStereoImages(Table& t) {
  t.Number("stereo_f_number", FIELD(stereo.lens.f_number), {0.7, 32.0}, "F-number of each lens.")
      .Number("stereo_transmission", FIELD(stereo.lens.transmission), {0.01, 1.0},
              "Share of the light that the lens transmits.")
      .Number("stereo_blur_px", FIELD(stereo.lens.blur_sigma_px), {0.0, 10.0},
              "Standard deviation of the lens' Gaussian point spread on the optical axis.")
      .Number("stereo_corner_blur_px", FIELD(stereo.lens.corner_blur_sigma_px), {0.0, 10.0},
              "Standard deviation of the lens' Gaussian point spread in the image's corners, at "
              "least that on the axis.")
      .Number("stereo_corner_illumination", FIELD(stereo.lens.corner_illumination), {0.05, 1.0},
              "Share of the light that reaches the corners, besides natural vignetting.")
      .Choice(
          "stereo_illuminant", FIELD(stereo.spectrum.illuminant), {"daylight", "incandescent"},
          "Spectrum of the light, for the sensor's response; illuminances in lux stay the same.")
      .Number("stereo_cut_off_nm", FIELD(stereo.spectrum.cut_off_nm), {400.0, 1100.0},
              "Longest wavelength that the lens' filter passes; from 1005: no filter.")
      .Number("stereo_quantum_efficiency_scale", FIELD(stereo.spectrum.quantum_efficiency_scale),
              {0.01, 1.7}, "Quantum efficiency as a multiple of the MT9V034's curve.");
}

void AddStereoSensor(Table& t) {
  t.Number("stereo_saturation_e", FIELD(stereo.sensor.saturation_e), {10.0, 1e7},
           "Electrons at full scale and a gain of 1.")
      .Number("stereo_read_noise_e", FIELD(stereo.sensor.read_noise_e), {0.0, 1e4},
              "Standard deviation of a pixel's temporal noise in the dark.")
      .Number("stereo_dark_current_e_s", FIELD(stereo.sensor.dark_current_e_s), {0.0, 1e6},
              "Dark current at 25 °C.")
      .Number("stereo_dark_current_doubling_k", FIELD(stereo.sensor.dark_current_doubling_k),
              {1.0, 100.0}, "Rise in temperature that doubles the dark current.")
      .Number("stereo_temperature_c", FIELD(stereo.sensor.temperature_c), {-60.0, 120.0},
              "Temperature of the sensor.")
      .Number("stereo_dsnu_e", FIELD(stereo.sensor.dsnu_e), {0.0, 1e4},
              "Dark signal non-uniformity: standard deviation of the pixels' offsets.")
      .Number("stereo_prnu_percent", FIELD(stereo.sensor.prnu), {0.0, 50.0, kPercent},
              "Photo response non-uniformity: standard deviation of the pixels' sensitivities.")
      .Number("stereo_row_noise_e", FIELD(stereo.sensor.row_noise_e), {0.0, 1e4},
              "Standard deviation of the offset that the pixels of a row share in one image.")
      .Integer("stereo_adc_bits", FIELD(stereo.sensor.adc_bits), {1, 16},
               "Resolution of the sensor's ADC.")
      .Integer("stereo_output_bits", FIELD(stereo.sensor.output_bits), {1, 16},
               "Bits per pixel of the image, at most the ADC's; a detector sees the upper eight.")
      .Number("stereo_black_level_dn", FIELD(stereo.sensor.black_level_dn), {0.0, 65535.0},
              "Signal without light, in steps of the ADC.")
      .Switch("stereo_noise", FIELD(stereo.sensor.noise),
              "Whether images have temporal noise, which differs from image to image.")
      .Switch("stereo_fixed_pattern", FIELD(stereo.sensor.fixed_pattern),
              "Whether the pixels are non-uniform.")
      .Switch("stereo_auto_exposure", FIELD(stereo.exposure.automatic),
              "Whether exposure time and gain are chosen by the image's mean.")
      .Number("stereo_exposure_set_point", FIELD(stereo.exposure.set_point), {0.01, 0.99},
              "Mean signal that automatic exposure aims at, as a fraction of full scale.")
      .Number("stereo_shortest_exposure_ms", FIELD(stereo.exposure.shortest_s), {1e-4, 1e4, kMilli},
              "Shortest exposure that automatic exposure may choose.")
      .Number("stereo_longest_exposure_ms", FIELD(stereo.exposure.longest_s), {1e-4, 1e4, kMilli},
              "Longest exposure that automatic exposure may choose; beyond it the gain rises.")
      .Number("stereo_largest_gain", FIELD(stereo.exposure.largest_gain), {1.0, 100.0},
              "Largest gain that automatic exposure may choose.")
      .Number("stereo_exposure_ms", FIELD(stereo.exposure.exposure_s), {1e-4, 1e4, kMilli},
              "Exposure time without automatic exposure.")
      .Number("stereo_gain", FIELD(stereo.exposure.gain), {1.0, 100.0},
              "Analogue gain without automatic exposure.");
}

void AddRgbdDepth(Table& t) {
  t.Switch("rgbd_near_mode", FIELD(rgbd.near_mode),
           "Whether the range is 0.4–3 m instead of 0.8–4 m.")
      .Integer("rgbd_depth_width_px", FIELD(rgbd.depth_width_px), {64, 4096},
               "Width of the depth image.")
      .Integer("rgbd_depth_height_px", FIELD(rgbd.depth_height_px), {64, 4096},
               "Height of the depth image.")
      .Number("rgbd_depth_focal_px", FIELD(rgbd.depth_focal_px), {10.0, 1e4},
              "Focal length of the depth camera.")
      .Number("rgbd_projector_baseline_m", FIELD(rgbd.projector_baseline_m), {0.001, 1.0},
              "Distance from the depth camera to the projector.")
      .Number("rgbd_disparity_step_px", FIELD(rgbd.disparity_step_px), {0.0, 10.0},
              "Quantisation step of the disparity.")
      .Number("rgbd_fixed_disparity_noise_px", FIELD(rgbd.parametric.fixed_disparity_noise_px),
              {0.0, 10.0},
              "Standard deviation of the disparity noise that all depth images of a view share; "
              "parametric model only.")
      .Number("rgbd_temporal_disparity_noise_px",
              FIELD(rgbd.parametric.temporal_disparity_noise_px), {0.0, 10.0},
              "Standard deviation of the disparity noise where dots are as strong as the image "
              "noise; parametric model only.")
      .Number(
          "rgbd_lateral_noise_px", FIELD(rgbd.parametric.lateral_noise_px), {0.0, 10.0},
          "Standard deviation of where outlines appear in the depth image; parametric model only.")
      .Number("rgbd_dot_signal_dn", FIELD(rgbd.infrared.dot_signal_dn), {0.0, 1e6},
              "Signal of a dot on a surface of reflectance 0.8 at 1 m.")
      .Number("rgbd_dot_irradiance_w_m2", FIELD(rgbd.infrared.dot_irradiance), {1e-6, 1e6},
              "Peak irradiance of a dot at 1 m.")
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
              "Contrast of the laser's speckle in a pixel.")
      .Integer("rgbd_matching_window_width_px", FIELD(rgbd.matching.block_width_px), {3, 15},
               "Width of the block that is matched; odd.")
      .Integer("rgbd_matching_window_height_px", FIELD(rgbd.matching.block_height_px), {3, 15},
               "Height of the block that is matched; odd.")
      .Number("rgbd_least_correlation", FIELD(rgbd.matching.least_correlation), {0.01, 0.99},
              "Least correlation coefficient of a match that is accepted.")
      .Number("rgbd_least_lead", FIELD(rgbd.matching.least_lead), {0.0, 0.99},
              "Least lead of a match's correlation over that of the next best disparity.")
      .Number("rgbd_most_unexplained", FIELD(rgbd.matching.most_unexplained), {0.0, 100.0},
              "Largest variance that a match may leave unexplained besides noise, as a share of "
              "what it explains.")
      .Number("rgbd_most_off_centre", FIELD(rgbd.matching.most_off_centre), {0.01, 0.5},
              "Largest offset of a partly lit block's evidence from its usual centre, as a share "
              "of the block's width.")
      .Number("rgbd_search_px", FIELD(rgbd.matching.search_px), {1.0, 200.0},
              "Range of disparities that is searched, in pixels of a 640-wide image.");
}

void AddRgbdMotion(Table& t) {
  AddMotion(t, "rgbd", FIELD(rgbd.motion));
  t.Number("rgbd_infrared_readout_ms", FIELD(rgbd.infrared_readout_s), {0.0, 1000.0, kMilli},
           "Time from the depth camera's first row to its last in a rolling shutter; 0: none.")
      .Number("rgbd_color_readout_ms", FIELD(rgbd.color.readout_s), {0.0, 1000.0, kMilli},
              "Time from the colour camera's first row to its last in a rolling shutter; 0: none.");
}

void AddRgbdColor(Table& t) {
  t.Integer("rgbd_color_width_px", FIELD(rgbd.color.width_px), {64, 4096},
            "Width of the colour image.")
      .Integer("rgbd_color_height_px", FIELD(rgbd.color.height_px), {64, 4096},
               "Height of the colour image.")
      .Number("rgbd_color_focal_px", FIELD(rgbd.color.focal_px), {10.0, 1e4},
              "Focal length of the colour camera.")
      .Number("rgbd_color_offset_m", FIELD(rgbd.color_offset_m), {-1.0, 1.0},
              "Position of the colour camera to the right of the depth camera.")
      .Number("rgbd_color_f_number", FIELD(rgbd.color.lens.f_number), {0.7, 32.0},
              "F-number of the colour camera's lens.")
      .Number("rgbd_color_transmission", FIELD(rgbd.color.lens.transmission), {0.01, 1.0},
              "Share of the light that the lens transmits.")
      .Number(
          "rgbd_color_blur_px", FIELD(rgbd.color.lens.blur_sigma_px), {0.0, 10.0},
          "Standard deviation of the lens' Gaussian point spread on the optical axis, in green.")
      .Number("rgbd_color_corner_blur_px", FIELD(rgbd.color.lens.corner_blur_sigma_px), {0.0, 10.0},
              "Standard deviation of the lens' Gaussian point spread in the image's corners, at "
              "least that on the axis.")
      .Number("rgbd_color_red_blur", FIELD(rgbd.color.red_blur), {0.1, 10.0},
              "Blur in red as a multiple of that in green.")
      .Number("rgbd_color_blue_blur", FIELD(rgbd.color.blue_blur), {0.1, 10.0},
              "Blur in blue as a multiple of that in green.")
      .Number("rgbd_color_corner_illumination", FIELD(rgbd.color.lens.corner_illumination),
              {0.05, 1.0},
              "Share of the light that reaches the corners, besides natural vignetting.")
      .Number("rgbd_color_electrons_per_lux_s", FIELD(rgbd.color.electrons_per_lux_s), {1.0, 1e8},
              "Electrons that a pixel collects per lux second.")
      .Number("rgbd_color_saturation_e", FIELD(rgbd.color.sensor.saturation_e), {10.0, 1e7},
              "Electrons at full scale of a colour pixel.")
      .Number("rgbd_color_read_noise_e", FIELD(rgbd.color.sensor.read_noise_e), {0.0, 1e4},
              "Standard deviation of the colour camera's read noise.")
      .Switch("rgbd_color_noise", FIELD(rgbd.color.sensor.noise),
              "Whether colour images have temporal noise, which differs from image to image.")
      .Switch("rgbd_color_fixed_pattern", FIELD(rgbd.color.sensor.fixed_pattern),
              "Whether the colour camera's pixels are non-uniform.")
      .Switch("rgbd_color_auto_exposure", FIELD(rgbd.color.auto_exposure),
              "Whether the exposure is chosen by the image's mean.")
      .Number("rgbd_color_mean_dn", FIELD(rgbd.color.mean_dn), {1.0, 254.0},
              "Mean of the sRGB-encoded image that automatic exposure aims at.")
      .Number("rgbd_color_exposure_ms", FIELD(rgbd.color.exposure_s), {1e-4, 1e4, kMilli},
              "Exposure time without automatic exposure.")
      .Integer("rgbd_edge_samples", FIELD(rgbd.edge_samples_per_pixel), {4, 256},
               "Rays through a pixel with more in it than one edge: 16, 64 or 256; 4: as for any "
               "other pixel.");
}

#undef FIELD

struct GroupedTable {
  Table table;
  std::vector<FactorGroup> groups;  // One for each factor of the table.

  void Add(FactorGroup group, void (*add)(Table&)) {
    add(table);
    groups.resize(table.infos().size(), group);
  }
};

const GroupedTable& AllFactors() {
  static const GroupedTable all = [] {
    GroupedTable factors;
    factors.Add(FactorGroup::kViewpoint, AddViewpoint);
    factors.Add(FactorGroup::kScene, AddScene);
    factors.Add(FactorGroup::kFacade, AddFacadeFactors);
    factors.Add(FactorGroup::kLight, AddLight);
    factors.Add(FactorGroup::kStereo, AddStereoCameras);
    factors.Add(FactorGroup::kStereo, AddStereoRig);
    factors.Add(FactorGroup::kStereo, AddStereoImages);
    factors.Add(FactorGroup::kStereo, AddStereoSensor);
    factors.Add(FactorGroup::kRgbd, AddRgbdDepth);
    factors.Add(FactorGroup::kRgbd, AddRgbdColor);
    factors.Add(FactorGroup::kRgbd, AddRgbdMotion);
    return factors;
  }();
  return all;
}

}  // namespace

const ParameterTable<TrialSettings>& Factors() {
  return AllFactors().table;
}

FactorGroup GroupOf(const std::string& factor) {
  const ParameterInfo* info = Factors().Find(factor);
  FENESTRA_CHECK(info != nullptr, "unknown factor " + factor);
  return AllFactors().groups[static_cast<size_t>(info - Factors().infos().data())];
}

bool Concerns(FactorGroup group, SensorKind sensor) {
  if (group == FactorGroup::kStereo) return sensor == SensorKind::kStereo;
  if (group == FactorGroup::kRgbd) return sensor == SensorKind::kRgbd;
  return true;
}

std::string LevelsText(const FactorValues& levels, std::string_view is) {
  std::string text;
  for (const auto& [name, value] : levels) {
    text += fmt::format("{}{}{}{}", text.empty() ? "" : ", ", name, is, ToString(value));
  }
  return text;
}

std::string LevelText(const FactorValues& levels, const std::string& name) {
  for (const auto& [level, value] : levels) {
    if (level == name) return ToString(value);
  }
  return "";
}

}  // namespace fenestra
