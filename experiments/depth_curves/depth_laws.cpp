#include "experiments/depth_curves/depth_laws.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/lighting.h"
#include "sim/structured_light/disparity.h"
#include "sim/structured_light/infrared_response.h"

namespace fenestra {
namespace {

// Light on the axis of a wall that faces the sensor, at the exposure that it gets.
InfraredLight LightOf(const InfraredResponse& response, double reflectance, double z_m,
                      double lux) {
  const InfraredOptions& o = response.options();
  constexpr double kLandauReflectance = 0.8;  // Of the wall on which Landau measured the dots.
  const double reflected_dn = o.dot_signal_dn * reflectance / kLandauReflectance;
  const InfraredLight light{.dot_dn = reflected_dn / (z_m * z_m),
                            .ambient_dn = reflected_dn * lux * kDaylightIrradiance830PerLux *
                                          o.filter_width_nm / response.DotIrradiance(),
                            .cos_projector = 1.0};
  return light.At(response.ExposureFor(light.dot_dn + light.ambient_dn));
}

InfraredResponse ResponseOf(const StructuredLightOptions& o) {
  return {o.infrared,
          CameraModel::Pinhole(o.depth_width_px, o.depth_height_px, o.depth_focal_px),
          {o.projector_baseline_m, 0.0, 0.0}};
}

// Where a correlation that falls with x gets too small, from 0 to `most`.
template <typename Correlation>
double Crossing(const Correlation& correlation, double least, double most) {
  double low = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + most);
    (correlation(middle) >= least ? low : most) = middle;
  }
  return low;
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

double PredictedAmbientLimit(const StructuredLightOptions& o, double reflectance, double z_m) {
  const InfraredResponse response = ResponseOf(o);
  constexpr double kMost_lx = 1e6;
  return Crossing(
      [&](double lux) { return response.Correlation(LightOf(response, reflectance, z_m, lux)); },
      o.matching.least_correlation, kMost_lx);
}

double PredictedReach(const StructuredLightOptions& o, double reflectance) {
  const InfraredResponse response = ResponseOf(o);
  constexpr double kMost_m = 100.0;
  return Crossing(
      [&](double z_m) {
        return response.Correlation(LightOf(response, reflectance, std::max(z_m, 1e-3), 0.0));
      },
      o.matching.least_correlation, kMost_m);
}

double ShadowWidth(const StructuredLightOptions& o, double zo_m, double zb_m) {
  return o.depth_focal_px * DisparityRange::kImageWidth / o.depth_width_px *
         o.projector_baseline_m * (1.0 / zo_m - 1.0 / zb_m);
}

}  // namespace fenestra
