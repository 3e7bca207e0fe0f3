#pragma once

#include <Eigen/Core>

#include "core/camera_model.h"
#include "sim/structured_light_sensor.h"

namespace fenestra {

/// What one pixel of the depth camera sees, in that camera's frame.
struct LitSurface {
  double z_m;                ///< NaN: nothing.
  Eigen::Vector3d normal_C;  ///< Facing the camera.
  bool sees_projector;
  double transmittance;  ///< Of the glass in between, one way.
  double reflectance_830nm;
  double irradiance_830;  ///< Ambient, on the surface [W/(m² nm)].
};

struct DepthReading {
  NoReturn no_return = NoReturn::kNone;
  double z_m = 0.0;  ///< 0 without a return.
};

/// Whether the projector's dots are recognised at a pixel, and at which depth.
///
/// The dots' signal and the noise of the infra-red image [DN], after Landau 2015:
///
///     s = s₁ (ρ / 0.8) cos θ_P / r_P² T²        r_P: distance to the projector [m]
///     a = s₁ (ρ / 0.8) E₈₃₀ Δλ / E_dot T        ambient light through the filter
///     σ² = σ_dark² + c_shot (s + a)
///
/// clipped at saturation; a window of nine dots is matched if 3 s/σ plus its noise exceeds
/// matching_snr. Its disparity is
///
///     d = f b / z + σ_d n,  rounded to disparity_step_px,  and  z' = f b / d.
class DotMatching {
 public:
  /// The sensor matches in an image of this width, whatever the width of the depth image [px].
  static constexpr double kImageWidth = 640.0;

  /// Keeps a reference to the options.
  DotMatching(const StructuredLightOptions& options, const CameraModel& depth);

  /// `ray`: of the pixel, with z = 1. The noises are standard normal variates of the window's
  /// evidence and of its disparity.
  DepthReading Read(const LitSurface& surface, const Eigen::Vector3d& ray, double evidence_noise,
                    double disparity_noise) const;

 private:
  NoReturn Evidence(const LitSurface& surface, double cos_projector, double squared_distance_m2,
                    double noise) const;

  const StructuredLightOptions& options_;
  double nearest_m_;
  double farthest_m_;
  double disparity_times_z_;  ///< f b [px m]
};

}  // namespace fenestra
