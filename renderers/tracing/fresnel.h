#pragma once

#include <cmath>

namespace fenestra {

/// Fresnel reflectance of one air-to-glass surface for unpolarised light.
/// c: cosine of the angle of incidence in air, in [0, 1]; n ≥ 1: refractive index.
///
///     c' = √(n² − 1 + c²)/n,   F = ½ [((c − n c')/(c + n c'))² + ((n c − c')/(n c + c'))²]
inline float FresnelReflectance(float c, float n) {
  const float c_inside = std::sqrt((n * n - 1.0f) + c * c) / n;
  const float s = (c - n * c_inside) / (c + n * c_inside);
  const float p = (n * c - c_inside) / (n * c + c_inside);
  return 0.5f * (s * s + p * p);
}

/// Reflectance of a pane with all reflections between its two faces, without absorption and
/// interference: R = F + (1 − F)² F / (1 − F²) = 2F / (1 + F). The pane transmits 1 − R.
/// Averaging the polarisations before summing the series overstates R at the Brewster angle by
/// less than 0.01.
inline float PaneReflectance(float c, float n) {
  // Written out, since a clamp is a function call to a vectoriser.
  const float c_up = c > 1e-4f ? c : 1e-4f;
  const float F = FresnelReflectance(c_up < 1.0f ? c_up : 1.0f, n);
  return 2.0f * F / (1.0f + F);
}

}  // namespace fenestra
