#pragma once

#include <opencv2/core.hpp>

#include "core/random/random_stream.h"
#include "renderers/tracing/render_types.h"
#include "sim/structured_light/dot_pattern.h"
#include "sim/structured_light/infrared_view.h"

namespace fenestra {

/// Brightness of dots and ambient light in the infra-red image [10-bit DN], and its noise. M. J.
/// Landau et al., "Simulating Kinect infrared and depth images", 2015:
///
///     s = s₁ (ρ / 0.8) cos θ_P / r_P² T²         of a dot; r_P: distance to the projector [m]
///     a = s₁ (ρ / 0.8) E₈₃₀ Δλ / E_dot T         of ambient light through the filter
///     σ² = σ_dark² + c_shot (s + a)
struct InfraredOptions {
  /// A dot on a surface of reflectance 0.8 at 1 m (Landau 2015: 5.90e8/r²).
  double dot_signal_dn = 590.0;
  double dark_noise_dn = 10.4;    ///< Standard deviation (Landau 2015).
  double shot_noise_dn = 0.5;     ///< Variance per DN of signal (Landau 2015: gamma noise).
  double saturation_dn = 1023.0;  ///< 10 bits.
  /// Peak irradiance of a dot at 1 m [W/m²]: 60 mW spread over the field of view, 11 % of it dots.
  double dot_irradiance = 0.574;
  /// Full width of the infra-red filter [nm]: how much ambient light competes with the dots.
  double filter_width_nm = 10.0;
  /// Spread of a dot, projector and camera together, besides the pixel's area [cells]. Chosen.
  double dot_sigma_px = 0.45;
  /// Standard deviation of a dot's brightness over its mean from pixel to pixel, by the laser's
  /// speckle: it belongs to the surface and the pose, so that it does not change from image to
  /// image. Grains of 1.22 λ N = 2 µm (f/2) in pixels of 10.4 µm, of one polarisation: 1/√27.
  double speckle_contrast = 0.19;
};

/// Throws InputError with all faults.
void Validate(const InfraredOptions& options);

/// Light that the infra-red camera receives at one pixel [DN]; none if no surface is hit.
struct InfraredLight {
  double dot_dn = 0.0;  ///< At the centre of a dot; 0 where the projector is hidden.
  double ambient_dn = 0.0;
  double cos_projector = 0.0;  ///< Cosine of the dots' angle of incidence; 0 if none arrive.
};

/// The light of a pixel. `aovs`: truths along one ray through each pixel's centre, with the
/// projector as the point whose view is tested; `ray`: the pixel's ray, z = 1; p_CP: the projector,
/// at +x of the camera.
InfraredLight InfraredLightAt(const InfraredOptions& options, const AovImages& aovs,
                              cv::Point pixel, const Eigen::Vector3d& ray,
                              const Eigen::Vector3d& p_CP);

/// The 10-bit image: at a surface of depth z a pixel in column u shows the pattern at u - f b/z. A
/// pixel that an outline or a shadow crosses gets the mean of its parts' light. p_CP: the
/// projector. `surface`: the stream of this view's laser speckle; `noise`: that of
/// this image's noise.
cv::Mat1w InfraredImage(const InfraredOptions& options, const SampledPattern& pattern,
                        const InfraredRays& rays, const InfraredView& view,
                        const Eigen::Vector3d& p_CP, const RandomStream& surface,
                        const RandomStream& noise);

}  // namespace fenestra
