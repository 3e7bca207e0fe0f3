#include "experiments/depth_curves/depth_laws.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/lighting.h"
#include "sim/structured_light/disparity.h"
#include "sim/structured_light/dot_pattern.h"

namespace fenestra {
namespace {

// The wall on which Landau measured the dots.
constexpr double kLandauReflectance = 0.8;

// The pattern's moments: means over displacements by fractions of a pixel.
SampledPattern::Moments MeanMoments(const InfraredOptions& infrared) {
  const SampledPattern pattern(infrared.dot_sigma_px);
  constexpr int kPhases = 8;
  SampledPattern::Moments mean{0.0, 0.0};
  for (int i = 0; i < kPhases; ++i) {
    const auto moments = pattern.MomentsAt((i + 0.5) / kPhases);
    mean.mean += moments.mean / kPhases;
    mean.variance += moments.variance / kPhases;
  }
  return mean;
}

// The noise variance [DN²] with which a block of dots of s DN still just correlates enough.
double LargestNoise(const StructuredLightOptions& o, const SampledPattern::Moments& m,
                    double s_dn) {
  const double rho = o.matching.least_correlation;
  const double c = o.infrared.speckle_contrast;
  return s_dn * s_dn *
         (m.variance / (rho * rho) - m.variance - c * c * (m.variance + m.mean * m.mean));
}

}  // namespace

double KhoshelhamSigma(double z_m) {
  return 1.425e-3 * z_m * z_m;
}

double NguyenSigma(double z_m, double angle_rad) {
  const double axial = 0.0012 + 0.0019 * std::pow(z_m - 0.4, 2);
  if (angle_rad <= std::numbers::pi / 3.0) return axial;
  return axial +
         0.0001 / std::sqrt(z_m) * std::pow(angle_rad / (std::numbers::pi / 2.0 - angle_rad), 2);
}

double NguyenLateralSigma(double angle_rad) {
  return 0.8 + 0.035 * angle_rad / (std::numbers::pi / 2.0 - angle_rad);
}

double OpenNiStep(double z_m) {
  return 2.85e-3 * z_m * z_m;
}

double MicrosoftStep(double z_m) {
  return 1.45e-3 * z_m * z_m;
}

ReachPrediction PredictedAmbientLimit(const StructuredLightOptions& o, double reflectance,
                                      double z_m) {
  const InfraredOptions& infrared = o.infrared;
  const SampledPattern::Moments m = MeanMoments(infrared);
  const double s_dn = infrared.dot_signal_dn * reflectance / kLandauReflectance / (z_m * z_m);
  const double dark = infrared.dark_noise_dn * infrared.dark_noise_dn + 1.0 / 12.0;
  const double acceptance_dn =
      std::max(0.0, (LargestNoise(o, m, s_dn) - dark) / infrared.shot_noise_dn - m.mean * s_dn);
  const double dn_per_lux = infrared.dot_signal_dn * reflectance / kLandauReflectance *
                            kDaylightIrradiance830PerLux * infrared.filter_width_nm /
                            infrared.dot_irradiance;
  return {.lux = std::min(acceptance_dn, infrared.saturation_dn) / dn_per_lux,
          .by_saturation = infrared.saturation_dn <= acceptance_dn};
}

double PredictedReach(const StructuredLightOptions& o, double reflectance) {
  const InfraredOptions& infrared = o.infrared;
  const SampledPattern::Moments m = MeanMoments(infrared);
  const double dark = infrared.dark_noise_dn * infrared.dark_noise_dn + 1.0 / 12.0;
  // k s² = dark + c_shot m s.
  const double k = LargestNoise(o, m, 1.0);
  const double b = infrared.shot_noise_dn * m.mean;
  const double s_dn = (b + std::sqrt(b * b + 4.0 * k * dark)) / (2.0 * k);
  return std::sqrt(infrared.dot_signal_dn * reflectance / kLandauReflectance / s_dn);
}

double ShadowWidth(const StructuredLightOptions& o, double zo_m, double zb_m) {
  return o.depth_focal_px * DisparityRange::kImageWidth / o.depth_width_px *
         o.projector_baseline_m * (1.0 / zo_m - 1.0 / zb_m);
}

}  // namespace fenestra
