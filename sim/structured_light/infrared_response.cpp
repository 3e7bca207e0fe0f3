#include "sim/structured_light/infrared_response.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/io/faults.h"
#include "core/io/input_error.h"
#include "sim/structured_light/dot_pattern.h"

namespace fenestra {
namespace {

// Landau's dot signal was fitted on a white wall.
constexpr double kReferenceReflectance = 0.8;

// The field of view of 640 x 480 px that the projector fills, f = 571.26 px: its solid angle as a
// plane at 1 m sees it, and the corner's tan² α.
constexpr double kFocal_px = 571.26;
constexpr double kFieldOfView_sr = 640.0 * 480.0 / (kFocal_px * kFocal_px);
constexpr double kCornerTangent2 = (320.0 * 320.0 + 240.0 * 240.0) / (kFocal_px * kFocal_px);

}  // namespace

void Validate(const InfraredOptions& o) {
  Faults faults("infra-red image");
  faults.Require(o.projector_power_w > 0.0, "the projector's power must be positive");
  faults.Require(o.dot_sigma_px >= 0.1 && o.dot_sigma_px <= 1.0,
                 "dots must spread over 0.1 to 1 px");
  faults.Require(o.dark_noise_dn >= 0.0 && o.shot_noise_dn >= 0.0, "noise must not be negative");
  for (const double contrast : {o.speckle_contrast, o.speckle_flicker}) {
    faults.Require(contrast >= 0.0 && contrast <= 1.0,
                   "the contrast of speckle must lie between 0 and 1");
  }
  faults.Require(o.corner_illumination > 0.0 && o.corner_illumination <= 1.0,
                 "the corners' illumination must be a share of the middle's, above 0");
  faults.Require(o.saturation_dn >= 1.0 && o.saturation_dn <= 1023.0,
                 "saturation must lie between 1 and 1023 DN, of 10 bits");
  faults.ThrowIfAny();
}

InfraredResponse::InfraredResponse(const InfraredOptions& options, const CameraModel& camera,
                                   const Eigen::Vector3d& p_CP)
    : options_(Validated(options)), camera_(camera.parameters()), p_CP_(p_CP) {
  const SampledPattern pattern(options.dot_sigma_px);
  constexpr int kPhases = 8;
  for (int i = 0; i < kPhases; ++i) {
    const SampledPattern::Moments moments = pattern.MomentsAt((i + 0.5) / kPhases);
    pattern_mean_ += moments.mean / kPhases;
    pattern_variance_ += moments.variance / kPhases;
  }
}

InfraredResponse InfraredResponse::WithCamera(const CameraModel& camera) const {
  InfraredResponse changed = *this;
  changed.camera_ = camera.parameters();
  return changed;
}

Eigen::Vector3d InfraredResponse::RayAt(cv::Point pixel) const {
  return {(pixel.x - camera_.cx_px) / camera_.fx_px, (pixel.y - camera_.cy_px) / camera_.fy_px,
          1.0};
}

InfraredLight InfraredResponse::LightAt(const AovImages& aovs, cv::Point place,
                                        const Eigen::Vector3d& ray) const {
  const auto z_m = static_cast<double>(aovs.depth_m(place));
  if (!std::isfinite(z_m)) return {};
  const double reflected_dn = options_.dot_signal_dn *
                              static_cast<double>(aovs.reflectance_830nm(place)) /
                              kReferenceReflectance;
  const auto T = static_cast<double>(aovs.transmittance(place));
  const double tangent2 = ray.head<2>().squaredNorm();
  const double cosine2 = 1.0 / (1.0 + tangent2);
  // The pattern passes a pane of glass twice; the irradiance is on the surface, behind the pane.
  InfraredLight light{.dot_dn = 0.0,
                      .ambient_dn = reflected_dn * T *
                                    static_cast<double>(aovs.irradiance_830(place)) *
                                    options_.filter_width_nm / DotIrradiance() * cosine2 * cosine2,
                      .cos_projector = 0.0};
  if (aovs.sees_point(place) != 0) {
    const Eigen::Vector3d to_projector = (p_CP_ - z_m * ray).normalized();
    const cv::Vec3f& n = aovs.normal_C(place);
    light.cos_projector = std::max(0.0, Eigen::Vector3d(n[0], n[1], n[2]).dot(to_projector));
    const double envelope =
        std::max(0.0, 1.0 - (1.0 - options_.corner_illumination) * tangent2 / kCornerTangent2);
    light.dot_dn = reflected_dn * T * T * light.cos_projector * cosine2 * std::sqrt(cosine2) *
                   envelope / (z_m * z_m);
  }
  return light;
}

double InfraredResponse::Exposure(const AovImages& aovs) const {
  if (!options_.auto_exposure) return 1.0;
  constexpr int kEvery = 8;  // Pixels, along rows and columns.
  constexpr double kShare = 0.995;
  std::vector<double> light_dn;
  for (int v = kEvery / 2; v < aovs.depth_m.rows; v += kEvery) {
    for (int u = kEvery / 2; u < aovs.depth_m.cols; u += kEvery) {
      const InfraredLight light = LightAt(aovs, {u, v});
      light_dn.push_back(light.dot_dn + light.ambient_dn);
    }
  }
  const auto brightest =
      light_dn.begin() + static_cast<ptrdiff_t>(kShare * static_cast<double>(light_dn.size() - 1));
  std::nth_element(light_dn.begin(), brightest, light_dn.end());
  return ExposureFor(*brightest);
}

double InfraredResponse::ExposureFor(double brightest_dn) const {
  if (!options_.auto_exposure) return 1.0;
  constexpr double kOfFullScale = 0.9;
  return std::min(1.0, kOfFullScale * options_.saturation_dn / std::max(brightest_dn, 1e-9));
}

double InfraredResponse::NoiseVariance(double light_dn) const {
  return options_.dark_noise_dn * options_.dark_noise_dn + 1.0 / 12.0 +
         options_.shot_noise_dn * light_dn;
}

double InfraredResponse::SpeckleVariance() const {
  const double fixed = options_.speckle_contrast * options_.speckle_contrast;
  const double flicker = options_.speckle_flicker * options_.speckle_flicker;
  return fixed + flicker + fixed * flicker;
}

double InfraredResponse::FlickerOverFixed() const {
  return options_.speckle_contrast > 0.0 ? options_.speckle_flicker / options_.speckle_contrast
                                         : 0.0;
}

double InfraredResponse::Correlation(const InfraredLight& light) const {
  const double s2 = light.dot_dn * light.dot_dn;
  const double m = pattern_mean_;
  const double explained = pattern_variance_ * s2;
  const double speckle = SpeckleVariance() * (pattern_variance_ + m * m) * s2;
  const double noise = NoiseVariance(m * light.dot_dn + light.ambient_dn);
  return std::sqrt(explained / (explained + speckle + noise));
}

double InfraredResponse::DotIrradiance() const {
  return options_.projector_power_w / (kFieldOfView_sr * pattern_mean_);
}

}  // namespace fenestra
