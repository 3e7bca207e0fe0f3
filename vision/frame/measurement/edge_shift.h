#pragma once

#include <Eigen/Core>

#include "core/geometry/camera_model.h"

namespace fenestra {

/// By how much edges in an image are displaced beyond what the model of an edge describes: by the
/// asymmetry of a lens' point spread, and by motion between the exposures of two cameras. The
/// displacement d of an edge at place ρ is taken for a smooth random field of the image,
///
///     d(ρ) ~ N(0, σ(ρ)² 1),              σ(ρ) = σ₀ + (σ₁ - σ₀) ρ²,
///     correlation of d(ρ) and d(ρ'):     exp(-|ρ - ρ'|² / 2ℓ²),   ℓ = 0.27,
///
/// ρ: place from the image's centre, of length 1 in the corners. Cameras are independent. So the
/// outer and the inner edge of a side are displaced alike, and so is all of a distant window; the
/// sides of a near window are displaced each in its own way.
///
/// ℓ is that of third-order coma, which displaces edges by d ∝ |S|² S, S ∝ ρ - ρ₀, where ρ₀ ~ N(0,
/// 0.3² 1) is where it vanishes: its correlation agrees with the above to 0.05 out to |ρ - ρ'| =
/// 0.6 about the centre.
struct EdgeShift {
  double centre_px = 0.0;  ///< σ₀
  double corner_px = 0.0;  ///< σ₁

  double SigmaAt(const Eigen::Vector2d& place) const;

  bool operator==(const EdgeShift&) const = default;
};

/// ρ of a pixel.
Eigen::Vector2d PlaceInImage(const CameraModel& camera, const Eigen::Vector2d& pixel);

/// Correlation of the displacements at two places.
double ShiftCorrelation(const Eigen::Vector2d& place, const Eigen::Vector2d& other);

}  // namespace fenestra
