#pragma once

#include <Eigen/Core>

namespace fenestra {

/// A straight edge as pixels of unit area gather it after a Gaussian point spread. A pixel whose
/// centre is d inside the edge, along the unit normal n, receives this share of the inside's light:
///
///     S(d) = ∫∫ Φ((d + n·x)/σ) dx over the pixel = Σ± ± G(d ± a ± b)/(4ab),
///     a = |n_x|/2, b = |n_y|/2,  G(x) = ½ [(x² + σ²) Φ(x/σ) + x σ φ(x/σ)],  G'' = Φ(x/σ).
///
/// The derivative by σ is σ S''(d), by the heat equation. Pixels; exact for any angle.
class BlurredEdge {
 public:
  /// σ ≥ 0 (below 0.02 px it counts as that); n: of length 1.
  BlurredEdge(double sigma_px, const Eigen::Vector2d& normal);

  struct Value {
    double share;
    double by_distance;
    double by_sigma;
  };
  Value At(double distance_px) const;
  /// Farther away than this the share is 0 or 1 to 1e-5.
  double reach_px() const { return 4.3 * sigma_ + a_ + b_; }

 private:
  double sigma_;
  double a_;
  double b_;
};

/// The bound on where an edge is in one row of pixels: σ_edge = σ_n/A √(2 √π σ_b), for a contrast
/// A, pixel noise σ_n that does not change across the edge, and a Gaussian blur σ_b [px] in which
/// the pixel's own area is contained. Contrast, blur and levels known; averaged over where in a
/// pixel the edge is.
double EdgeBound_px(double contrast, double noise, double blur_sigma_px);

}  // namespace fenestra
