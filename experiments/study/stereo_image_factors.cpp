#include "experiments/study/factor_tables.h"

namespace fenestra {
namespace {

// The field of the settings that a factor stands for.
#define FIELD(path) FENESTRA_FIELD(path)

void AddStereoImages(FactorTable& t) {
  t.Number("stereo_f_number", FIELD(stereo.lens.f_number), {0.7, 32.0}, "F-number of each lens.")
      .Number("stereo_transmission", FIELD(stereo.lens.transmission), {0.01, 1.0},
              "Share of the light that the lens transmits.")
      .Number("stereo_blur_px", FIELD(stereo.lens.blur_sigma_px), {0.0, 10.0},
              "Standard deviation of the lens' Gaussian point spread on the optical axis.")
      .Number("stereo_corner_blur_px", FIELD(stereo.lens.corner_blur_sigma_px), {0.0, 10.0},
              "Standard deviation of the lens' Gaussian point spread in the image's corners, at "
              "least that on the axis.")
      .Number("stereo_corner_coma_px", FIELD(stereo.corner_coma_px), {-5.0, 5.0},
              "Sagittal coma in the image's corners; positive: tails point outwards.")
      .Number("stereo_focus_distance_m", FIELD(stereo.focus_distance_m), {0.05, 1e6},
              "Distance at which the middle of each image is in focus.")
      .Number("stereo_corner_illumination", FIELD(stereo.lens.corner_illumination), {0.05, 1.0},
              "Share of the light that reaches the corners, besides natural vignetting.")
      .Number(
          "stereo_veiling_glare_percent", FIELD(stereo.lens.veiling_glare), {0.0, 50.0, kPercent},
          "Veiling glare index: light in the image of a small black patch, of the bright field's.")
      .Choice(
          "stereo_illuminant", FIELD(stereo.spectrum.illuminant), {"daylight", "incandescent"},
          "Spectrum of the light, for the sensor's response; illuminances in lux stay the same.")
      .Number("stereo_cut_off_nm", FIELD(stereo.spectrum.cut_off_nm), {400.0, 1100.0},
              "Longest wavelength that the lens' filter passes; from 1005: no filter.")
      .Number("stereo_quantum_efficiency_scale", FIELD(stereo.spectrum.quantum_efficiency_scale),
              {0.01, 1.7}, "Quantum efficiency as a multiple of the MT9V034's curve.");
}

void AddStereoSensor(FactorTable& t) {
  t.Number("stereo_saturation_e", FIELD(stereo.sensor.saturation_e), {10.0, 1e7},
           "Electrons that would fill the range at a gain of 1, were the response linear.")
      .Number("stereo_linear_range_percent", FIELD(stereo.sensor.linear_range),
              {1.0, 100.0, kPercent},
              "Share of the range up to which the response is linear, with a shoulder beyond.")
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
      .Switch("stereo_own_exposure", FIELD(stereo.own_exposure),
              "Whether each camera chooses its exposure by its own image; otherwise both have the "
              "left one's.")
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

#undef FIELD

}  // namespace

void AddStereoImageFactors(FactorTable& table) {
  AddStereoImages(table);
  AddStereoSensor(table);
}

}  // namespace fenestra
