#include "experiments/study/factor_tables.h"

namespace fenestra {

// The field of the settings that a factor stands for.
#define FIELD(path) FENESTRA_FIELD(path)

void AddRgbdColorFactors(FactorTable& t) {
  t.Integer("rgbd_color_width_px", FIELD(rgbd.color.width_px), {64, 4096},
            "Width of the colour image.")
      .Integer("rgbd_color_height_px", FIELD(rgbd.color.height_px), {64, 4096},
               "Height of the colour image.")
      .Number("rgbd_color_focal_px", FIELD(rgbd.color.focal_px), {10.0, 1e4},
              "Focal length of the colour camera.")
      .Number("rgbd_color_k1", FIELD(rgbd.color.distortion.k1), {-1.0, 1.0},
              "Radial distortion of the colour lens, second order.")
      .Number("rgbd_color_k2", FIELD(rgbd.color.distortion.k2), {-2.0, 2.0},
              "Radial distortion of the colour lens, fourth order.")
      .Number("rgbd_color_k3", FIELD(rgbd.color.distortion.k3), {-2.0, 2.0},
              "Radial distortion of the colour lens, sixth order.")
      .Number("rgbd_color_p1", FIELD(rgbd.color.distortion.p1), {-0.1, 0.1},
              "Tangential distortion of the colour lens, coefficient p1 of OpenCV's model.")
      .Number("rgbd_color_p2", FIELD(rgbd.color.distortion.p2), {-0.1, 0.1},
              "Tangential distortion of the colour lens, coefficient p2 of OpenCV's model.")
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
      .Number(
          "rgbd_color_veiling_glare_percent", FIELD(rgbd.color.lens.veiling_glare),
          {0.0, 50.0, kPercent},
          "Veiling glare index: light in the image of a small black patch, of the bright field's.")
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

}  // namespace fenestra
