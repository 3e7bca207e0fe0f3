#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <opencv2/core.hpp>

#include "core/geometry/camera_model.h"
#include "renderers/tracing/render_types.h"

namespace fenestra {

/// Brightness of dots and ambient light in the infra-red image [10-bit DN], and its noise, at the
/// longest exposure. α: angle of the pixel's ray to the optical axis; m: mean of the pattern.
///
///     s = s₁ (ρ / 0.8) cos θ_P F(α) / z² T²       of a dot, θ_P: its angle of incidence
///     a = s₁ (ρ / 0.8) E₈₃₀ Δλ / E_dot cos⁴ α T   of ambient light through the filter
///     F = cos³ α (1 - (1 - c) tan² α / tan² α_corner)
///     E_dot = P / (Ω m)                           the irradiance of a dot's centre at 1 m
///
/// cos³ α: a lens passes cos⁴ α of a surface's light, and dots that are as far apart in the image
/// everywhere send 1 / cos α as much to a plane across the axis. A pixel gets s times the pattern,
/// times the laser's speckle, and a; the variance of its noise is σ_dark² + 1/12 + c_shot times
/// that.
struct InfraredOptions {
  /// A dot on a surface of reflectance 0.8, at 1 m on the axis (M. J. Landau et al., "Simulating
  /// Kinect infrared and depth images", 2015: 5.90e8/r²).
  double dot_signal_dn = 590.0;
  /// Fitted to where a recorded concrete floor is lost (TUM RGB-D, freiburg2) if that reflects 0.4;
  /// only the quotient of the two is known: 0.86 to 1.44 DN for 0.3 to 0.5. Landau's 10.4 DN is the
  /// residual on dots, speckle included.
  double dark_noise_dn = 1.15;
  /// Variance per DN of signal: 10 bits of 31,600 electrons, those of 45 dB (MT9M001).
  double shot_noise_dn = 0.032;
  double saturation_dn = 1023.0;  ///< 10 bits.
  /// Radiant power of the projector (60 mW: Landau 2015), spread evenly over the field of view.
  double projector_power_w = 0.060;
  /// Full width of the infra-red filter [nm]: how much ambient light competes with the dots.
  /// Assumed.
  double filter_width_nm = 10.0;
  /// Spread of a dot, projector and camera together, besides the pixel's area [cells]. Chosen.
  double dot_sigma_px = 0.45;
  /// Share of the dots' light in the corners, besides the powers of cos α. Assumed.
  double corner_illumination = 0.7;
  /// The laser's speckle multiplies the dots in each pixel with a gamma variate of mean 1 and of
  /// this standard deviation, which belongs to the surface and the pose, and with another that is
  /// drawn for each image. Together 0.48; Landau fitted 0.47 to images (shape 4.54). The division
  /// is chosen so that depth changes by 0.2 to 0.5 of a step of 1/8 px from image to image, as
  /// recorded.
  double speckle_contrast = 0.42;
  double speckle_flicker = 0.21;
  /// Whether the exposure is shortened where light would saturate the image, as drivers do; assumed
  /// to keep 99.5 % of the pixels below 90 % of full scale.
  bool auto_exposure = true;
};

/// Throws InputError with all faults.
void Validate(const InfraredOptions& options);

/// Light that the infra-red camera receives at one pixel [DN]; none if no surface is hit.
struct InfraredLight {
  double dot_dn = 0.0;  ///< At the centre of a dot; 0 where the projector is hidden.
  double ambient_dn = 0.0;
  double cos_projector = 0.0;  ///< Cosine of the dots' angle of incidence; 0 if none arrive.

  /// At a share of the longest exposure.
  InfraredLight At(double exposure) const {
    return {exposure * dot_dn, exposure * ambient_dn, cos_projector};
  }
};

/// What the pixels of an infra-red camera receive of a projector and of the surroundings, and how
/// well a block of them correlates with the pattern.
class InfraredResponse {
 public:
  /// `camera`: without distortion; p_CP: the projector, at +x of the camera.
  InfraredResponse(const InfraredOptions& options, const CameraModel& camera,
                   const Eigen::Vector3d& p_CP);

  /// The same with another camera.
  InfraredResponse WithCamera(const CameraModel& camera) const;

  const InfraredOptions& options() const { return options_; }
  const Eigen::Vector3d& p_CP() const { return p_CP_; }

  /// The light of a pixel at the longest exposure. `aovs`: truths along one ray through each
  /// pixel's centre, with the projector as the point whose view is tested; `ray`: the pixel's ray,
  /// z = 1.
  InfraredLight LightAt(const AovImages& aovs, cv::Point place, const Eigen::Vector3d& ray) const;
  InfraredLight LightAt(const AovImages& aovs, cv::Point pixel) const {
    return LightAt(aovs, pixel, RayAt(pixel));
  }
  Eigen::Vector3d RayAt(cv::Point pixel) const;
  /// The exposure of this view, as a share of the longest one.
  double Exposure(const AovImages& aovs) const;
  /// The same where 99.5 % of the pixels receive no more than this at the longest one [DN].
  double ExposureFor(double brightest_dn) const;

  /// Variance of a pixel's noise, rounding included, where it receives `light_dn` [DN²].
  double NoiseVariance(double light_dn) const;
  /// The expected correlation of a block whose pixels all receive this light, v: variance of the
  /// pattern, c: contrast of all speckle,
  ///
  ///     ρ = √v s / √(v s² + c² (v + m²) s² + noise variance at m s + a).
  double Correlation(const InfraredLight& light) const;
  /// c² of both kinds of speckle together.
  double SpeckleVariance() const;
  /// Contrast of the flicker over that of the fixed speckle; 0 where nothing is fixed.
  double FlickerOverFixed() const;
  /// E_dot [W/m²].
  double DotIrradiance() const;
  /// m and v, means over displacements by fractions of a pixel.
  double pattern_mean() const { return pattern_mean_; }
  double pattern_variance() const { return pattern_variance_; }

 private:
  InfraredOptions options_;
  CameraParameters camera_;
  Eigen::Vector3d p_CP_;
  double pattern_mean_ = 0.0;
  double pattern_variance_ = 0.0;
};

/// A gamma variate of mean 1 and standard deviation c, of a standard normal number ν:
/// max(0, 1 - c²/9 + c ν/3)³. Source: E. B. Wilson and M. M. Hilferty, 1931; moments are right to
/// 1 % up to c = 0.5.
class GammaVariate {
 public:
  explicit GammaVariate(double c)
      : mean_(static_cast<float>(1.0 - c * c / 9.0)), slope_(static_cast<float>(c / 3.0)) {}
  float operator()(float normal) const {
    const float root = std::max(0.0f, mean_ + slope_ * normal);
    return root * root * root;
  }

 private:
  float mean_;
  float slope_;
};

}  // namespace fenestra
